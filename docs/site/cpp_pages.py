"""Sphinx extension: one page of the C++ reference per namespace, from the XML that Doxygen made of the public headers."""

import pathlib
import re
import xml.etree.ElementTree as ET

from sphinx import addnodes

PAGE = """# {title}

{purpose}

```{{eval-rst}}
.. doxygennamespace:: {name}
   :content-only:
   :members:
```
"""
INTERNAL = ("std", "detail")
# Sphinx does not parse designated initialisers in declarations; the pages leave them out.
DESIGNATED = re.compile(r"<initializer>(= )?\{\..*?</initializer>", re.S)


def is_public(name):
    return not any(part in INTERNAL for part in name.split("::"))


def namespaces(xml):
    """(name, purpose) of each public namespace."""
    for file in sorted(xml.glob("namespace*.xml")):
        compound = ET.parse(file).find("compounddef")
        name = compound.findtext("compoundname")
        parts = ("".join(compound.find(part).itertext()) for part in ("briefdescription", "detaileddescription"))
        if is_public(name):
            yield name, " ".join(" ".join(parts).split())


def leave_out_designated_initialisers(xml):
    for file in xml.glob("*.xml"):
        text = file.read_text(encoding="utf-8")
        if DESIGNATED.search(text):
            file.write_text(DESIGNATED.sub("", text), encoding="utf-8")


def write_pages(app):
    xml = pathlib.Path(app.config.breathe_projects[app.config.breathe_default_project])
    leave_out_designated_initialisers(xml)
    folder = pathlib.Path(app.srcdir) / "docs/site/reference/cpp"
    folder.mkdir(parents=True, exist_ok=True)
    for name, purpose in namespaces(xml):
        page = PAGE.format(title=name, purpose=purpose, name=name)
        (folder / (name.replace("::", "_") + ".md")).write_text(page, encoding="utf-8")


def keep_out_of_contents(app, doctree):
    """Breathe enters every member into the table of contents of all pages, whose thousands of lines take minutes."""
    if app.env.docname.startswith("docs/site/reference/cpp/"):
        for signature in doctree.findall(addnodes.desc_signature):
            signature["_toc_name"] = ""


def setup(app):
    app.connect("builder-inited", write_pages)
    app.connect("doctree-read", keep_out_of_contents, priority=100)  # before Sphinx collects the contents
    return {"parallel_read_safe": True}
