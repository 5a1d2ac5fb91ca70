"""Sphinx extension: the Python reference lists every public name of the package, and nothing else; attributes are described by
the comments beside them."""

import re
import sys

import tabor
from sphinx.errors import ExtensionError
from sphinx.pycode import ModuleAnalyzer

PAGE = "docs/site/python_reference"
LISTED = re.compile(r"^   ((?:ehl\.)?\w+)$", re.M)
ALIASES = {"Progress", "Value", "ehl.Source"}  # of types: described in words at the end of the page


def public_names():
    return {*tabor.__all__, "Warning", *(f"ehl.{name}" for name in tabor.ehl.__all__)} - ALIASES - {"ehl"}


def compare(app, env, docnames):
    listed = set(LISTED.findall(env.doc2path(PAGE).read_text(encoding="utf-8")))
    different = sorted(listed ^ public_names())
    if different:
        raise ExtensionError(f"{PAGE}.md and the public names of tabor differ in: {', '.join(different)}")


def take_comments(app):
    """Classes say that they are of `tabor`; the comments of their attributes stand in the private module that defines them."""
    package = ModuleAnalyzer.for_module("tabor")
    package.analyze()
    for name in [name for name in sys.modules if name.startswith("tabor._") and name != "tabor._tabor"]:
        module = ModuleAnalyzer.for_module(name)
        module.analyze()
        package.attr_docs.update(module.attr_docs)
        package.annotations.update(module.annotations)


def setup(app):
    app.connect("builder-inited", take_comments)
    app.connect("env-before-read-docs", compare)
    return {"parallel_read_safe": True}
