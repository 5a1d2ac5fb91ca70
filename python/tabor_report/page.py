"""The self-contained HTML page: what the template needs, and nothing that is fetched from elsewhere."""

import base64
import re
from pathlib import Path

import jinja2
from markupsafe import Markup, escape

from tabor_report import citations, page_ehl, page_single, page_study, style

_PAGES = {"study": page_study, "single": page_single, "ehl": page_ehl}
SCREEN_PIXELS_PER_INCH = 115  # letters of the figures a little larger than on paper


def render(source, figures, command):
    """HTML text. figures: [(Drawn, png bytes, svg bytes)]."""
    sections = _PAGES[source.kind].sections(source)
    return _template().render(
        title=source.title,
        subtitle=_subtitle(source),
        answers=_answers(source),
        warnings=source.warnings,
        figures=[_figure(number, *parts) for number, parts in enumerate(figures, 1)],
        bibtex=citations.bibtex(source.facts),
        command=source.facts.get("command", ""),
        report_command=command,
        config=source.facts.get("config_toml", ""),
        created=source.facts.get("created", ""),
        version=source.facts.get("software_version", ""),
        **sections,
    )


def _answers(source):
    """What friction against density says; nothing for a result without it."""
    short, every = getattr(source, "answers", ([], []))
    return {"short": short, "all": every if len(every) > len(short) else []}


def _template():
    folder = Path(__file__).resolve().parent / "templates"
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["symbols"] = symbols
    return environment.get_template("report.html")


def symbols(text):
    """p_sat and its like with a real subscript; everything else is escaped."""
    return Markup(re.sub(r"\b(A|p|τ)_(real|lub|sat|y)\b", r"\1<sub>\2</sub>", str(escape(text))))


def _subtitle(source):
    if source.kind == "study":
        scans, cases = len(source.scans), len(source.table)
        return f"{scans} scan{'s' * (scans != 1)}, {cases} case{'s' * (cases != 1)}"
    if source.kind == "ehl":
        return "a sweep" if source.is_sweep else "one case"
    return f"{len(source.states)} state{'s' * (len(source.states) != 1)} of one scan"


def _figure(number, drawn, png, svg):
    # A map as SVG is a raster in a wrapper; as an <img> an SVG's ids cannot clash with another's.
    kind, data = ("image/png", png) if drawn.is_map else ("image/svg+xml", svg)
    return {
        "number": number,
        "width": round(SCREEN_PIXELS_PER_INCH * style.width_in_inches(png)),
        "name": drawn.name,
        "title": drawn.title,
        "caption": drawn.caption,
        "uri": f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}",
        "csv": [f"figures/{drawn.name}{suffix}.csv" for suffix in drawn.data],
    }
