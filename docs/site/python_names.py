"""Sphinx extension: the Python reference lists every public name of the package, and nothing else."""

import re

import tabor
from sphinx.errors import ExtensionError

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


def setup(app):
    app.connect("env-before-read-docs", compare)
    return {"parallel_read_safe": True}
