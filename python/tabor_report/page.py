"""The self-contained HTML page: what the template needs, and nothing that is fetched from elsewhere."""

import base64
import re
from dataclasses import dataclass
from pathlib import Path

import jinja2
from markupsafe import Markup, escape

from tabor_report import citations, page_ehl, page_parameters, page_single, page_spectra, page_study, style

# What a kind of result does not have its page leaves out.
_NOTHING = {
    "answer": None,
    "highlights": [],
    "scans": [],
    "treatments": [],
    "settings": [],
    "results": {"intro": "", "header": [], "rows": [], "n_total": 0, "n_text": 0},
    "averages": {"header": [], "rows": [], "n_text": 0},
}
_PAGES = {"study": page_study, "single": page_single, "ehl": page_ehl, "psd": page_spectra, "params": page_parameters}
LARGEST_CSV = 300_000  # bytes of a table in the page; larger ones come with --figures
SCREEN_PIXELS_PER_INCH = 115  # letters of the figures a little larger than on paper


@dataclass
class Shown:
    """One figure of the page; live: what its interactive form needs, None where it has none."""

    drawn: object
    picture: bytes  # PNG of a map, SVG of curves
    live: dict

    @staticmethod
    def of(drawn, live):
        # A map as SVG is a raster in a wrapper; as an <img> an SVG's ids cannot clash with another's.
        picture = style.png(drawn.figure) if drawn.is_map else style.svg(drawn.figure)
        return Shown(drawn, picture, live.curves(drawn) if live else None)


def render(source, figures, command, live=None):
    """HTML text. figures: [Shown]; live: a live_page.Live, None for a page of still figures."""
    sections = _PAGES[source.kind].sections(source)
    maps = live.maps if live else []
    return _template().render(
        title=source.title,
        subtitle=_subtitle(source),
        answers=_answers(source),
        warnings=source.warnings,
        figures=[_figure(number, shown) for number, shown in enumerate(figures, 1)],
        maps=maps,
        scripts=live.scripts() if live and live.document else None,
        bibtex=citations.bibtex(source.facts),
        command=source.facts.get("command", ""),
        report_command=command,
        config=source.facts.get("config_toml", ""),
        created=source.facts.get("created", ""),
        version=source.facts.get("software_version", ""),
        **{**_NOTHING, **sections},
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
    if source.kind == "psd":
        scans = sum(not one.is_mean for one in source.sets)
        return f"{scans} scans" if scans > 1 else "one scan"
    if source.kind == "params":
        groups = f", {len(source.groups)} group{'s' * (len(source.groups) != 1)}" if source.is_grouped else ""
        return f"{len(source.scans)} scan{'s' * (len(source.scans) != 1)}{groups}"
    if source.kind == "ehl":
        return "a sweep" if source.is_sweep else "one case"
    if not source.states:
        return "two scans put together" if source.combination else "one surface"
    return f"{len(source.states)} state{'s' * (len(source.states) != 1)} of one scan"


def _figure(number, shown):
    drawn = shown.drawn
    kind = "image/png" if drawn.is_map else "image/svg+xml"
    tables = {f"{drawn.name}{suffix}.csv": text for suffix, text in drawn.data.items()}
    return {
        "number": number,
        "width": round(SCREEN_PIXELS_PER_INCH * style.width_in_inches(shown.picture)),
        "name": drawn.name,
        "title": drawn.title,
        "caption": drawn.caption,
        "uri": _uri(kind, shown.picture),
        "ending": "png" if drawn.is_map else "svg",
        "csv": {name: _uri("text/csv", text.encode()) for name, text in tables.items() if len(text) <= LARGEST_CSV},
        "large_csv": [name for name, text in tables.items() if len(text) > LARGEST_CSV],
        "live": shown.live,
    }


def _uri(kind, data):
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"
