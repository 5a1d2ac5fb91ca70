"""The self-contained HTML page: what the template needs, and nothing that is fetched from elsewhere."""

import re
from dataclasses import dataclass
from pathlib import Path

import jinja2
from markupsafe import Markup, escape

from tabor.report import citations, page_ehl, page_parameters, page_single, page_slide, page_spectra, page_study, remarks, still, style, units
from tabor.report.output import LARGEST_IN_PAGE

# What a kind of result does not have its page leaves out.
_NOTHING = {
    "answer": None,
    "highlights": [],
    "scans": [],
    "treatments": [],
    "settings": [],
    "settings_title": "Material and settings",
    "results": {"intro": "", "header": [], "rows": [], "n_total": 0, "n_text": 0},
    "averages": {"header": [], "rows": [], "n_text": 0},
}
_PAGES = {"study": page_study, "single": page_single, "slide": page_slide, "ehl": page_ehl, "psd": page_spectra, "params": page_parameters}
LARGEST = 9.8e6  # bytes of a page, without what its texts and tables take
# A folder or file that is so called keeps its name.
_LOWERED = re.compile(r"(?<![\w.-])(A|p|τ|tau)_(real|lub|sat|y|(?<=A_)(?:dry|wet)|(?<=τ_)b)(?![\w-])(?!\.\w)(?!/(?!P\b|p_sat\b|A₀|\(A₀))")
_RAISED = re.compile(r"(?<![\w/.-])(C)([12]D)(?![\w-])(?!\.\w)")
_SPOKEN = {
    ("A", "real"): "contact area",
    ("A", "lub"): "lubricated contact area",
    ("A", "dry"): "dry contact area",
    ("A", "wet"): "wet contact area",
    ("p", "sat"): "saturation pressure",
    ("τ", "y"): "shear strength",
    ("τ", "b"): "boundary shear strength",
    ("tau", "y"): "shear strength",
}
SCREEN_PIXELS_PER_INCH = 115  # letters of the figures a little larger than on paper


@dataclass
class Shown:
    """One figure of the page; live: what its interactive form needs, None where it has none."""

    drawn: object
    picture: bytes  # PNG of a map, SVG of curves
    live: dict
    width: float  # inches
    tables: dict  # {file name: text} of those that the page holds
    large_tables: list  # names of those that come with --figures

    @staticmethod
    def of(drawn, live, pictures):
        """pictures: {format: bytes} that are drawn already."""
        # A map as SVG is a raster in a wrapper; as an <img> an SVG's ids cannot clash with another's.
        form, draw = ("png", style.quick_png) if drawn.is_map else ("svg", style.svg)
        picture = pictures.get(form) or draw(drawn.drawing)
        tables = drawn.tables()
        small = {name: text for name, text in tables.items() if not callable(text) and len(text) <= LARGEST_IN_PAGE}
        large = [name for name in tables if name not in small]
        return Shown(drawn, picture, live.curves(drawn) if live else None, still.width_in_inches(picture), small, large)


def render(source, figures, command, live=None):
    """HTML text. figures: [Shown]; live: a live_page.Live, None for a page of still figures."""
    sections = _PAGES[source.kind].sections(source)
    maps = live.maps if live else []
    scripts = live.scripts() if live and live.document else None
    doubts, information = remarks.parted(source.warnings)
    figures, left_out = still.fitted(figures, LARGEST - _size(figures, maps, scripts or {}))
    return _template().render(
        title=source.title,
        subtitle=_subtitle(source),
        answers=_answers(source),
        places=getattr(source, "places", None),
        warnings=doubts,
        information=information,
        figures=[_figure(number, shown) for number, shown in enumerate(figures, 1)],
        left_out=left_out,
        has_pictures=any(shown.drawn.is_map for shown in figures),
        maps=maps,
        other_scans=live.n_other_scans if live else 0,
        scripts=scripts,
        bibtex=citations.bibtex(source.facts),
        command=source.facts.get("command", ""),
        report_command=command,
        config=source.facts.get("config_toml", ""),
        created=source.facts.get("created", ""),
        version=source.facts.get("software_version", ""),
        **{**_NOTHING, **sections},
    )


def _size(figures, maps, scripts):
    """Bytes of the page beside its still pictures."""
    tables = sum(4 * len(text) / 3 for shown in figures for text in shown.tables.values())
    return tables + sum(map(len, scripts.values())) + sum(len(item["data"]) + sum(map(len, item["pictures"].values())) for item in maps)


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
    environment.filters["spoken"] = spoken
    return environment.get_template("report.html")


def symbols(text):
    """p_sat and its like with a real subscript, C1D with a superscript; everything else is escaped, and files keep their names."""
    text = _LOWERED.sub(_lowered, str(escape(text)))
    return Markup(_RAISED.sub(r"\1<sup>\2</sup>", text))


def spoken(text):
    """The same for a text that is read aloud: what the figures call it in place of a symbol with an index."""
    return _LOWERED.sub(lambda found: _SPOKEN.get((found[1], found[2]), found[0]), text)


def _lowered(found):
    return f"{'τ' if found[1] == 'tau' else found[1]}<sub>{found[2]}</sub>"


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
    if source.kind == "slide":
        return f"slid {units.length(source.states[-1].distance)}"
    if not source.states:
        return "two scans put together" if source.combination else "one surface"
    return f"{len(source.states)} state{'s' * (len(source.states) != 1)} of one scan"


def _figure(number, shown):
    drawn = shown.drawn
    kind, ending = still.kind(shown.picture)
    return {
        "number": number,
        "width": round(SCREEN_PIXELS_PER_INCH * shown.width),
        "name": drawn.name,
        "title": drawn.title,
        "caption": drawn.caption,
        "uri": still.uri(kind, shown.picture),
        "ending": ending,
        "csv": {name: still.uri("text/csv", text.encode()) for name, text in shown.tables.items()},
        "large_csv": shown.large_tables,
        "live": shown.live,
    }
