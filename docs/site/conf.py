"""How Sphinx makes the web pages; tools/docs calls it on a folder of links to what is shown."""

import importlib.util
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))
MATHJAX = pathlib.Path(importlib.util.find_spec("sphinx-mathjax-offline").submodule_search_locations[0])

project = "tabor"
author = "The tabor authors"
copyright = author
version = release = re.search(r"project\(tabor VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]

extensions = ["myst_nb", "sphinx.ext.autosummary", "sphinx.ext.mathjax", "numpydoc", "breathe", "sphinx_copybutton", "cpp_pages",
              "python_names"]
source_suffix = {".rst": "restructuredtext", ".md": "myst-nb", ".ipynb": "myst-nb"}  # stubs of names take the first
templates_path = [str(HERE / "templates")]
exclude_patterns = ["README.md", "docs/site/index.md", "docs/site/templates"]

# Headings are linked to as on GitHub.
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]

nb_execution_mode = "off"  # notebooks hold their outputs (tools/notebooks), and the tests run them

toc_object_entries = False  # names of members are found by the search

numpydoc_show_class_members = False  # autodoc describes them
autodoc_typehints = "none"

breathe_projects = {"tabor": str(ROOT / "build/api/xml")}
breathe_default_project = "tabor"

html_theme = "furo"
html_title = f"tabor {release}"
html_static_path = [str(HERE / "static"), str(MATHJAX / "static")]
mathjax_path = "mathjax/tex-chtml.js"  # beside the pages, which ask nothing of any other address
html_css_files = ["site.css"]
html_show_sourcelink = False
