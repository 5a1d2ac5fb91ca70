"""Which options of the report make sense for which kind of result; the others are rejected."""

from tabor.report.errors import UsageError

_OF_STUDIES = ("scan", "all_scans", "pressure", "density", "error_bar")
_DRAWN_INSTEAD = {
    "single": "the file holds one scan, and the maps of its states are all drawn",
    "slide": "the file holds one sheet, whose way is drawn as a whole",
    "params": "the file holds a table of parameters, which is shown as a whole",
    "psd": "the file holds spectra, which are all drawn",
    "ehl": "the file holds a result of 'tabor ehl', which is drawn as a whole",
}


def check(source, options):
    """Raises UsageError for the first option given that would change nothing."""
    values = {name: getattr(options, name) for name in _OF_STUDIES}
    given = [name for name, value in values.items() if value is not None and value is not False]
    if not given:
        return
    if source.kind != "study":
        raise UsageError(
            f"{_flag(given[0])} chooses among the cases of a study, and {source.path} is none: "
            f"{_DRAWN_INSTEAD[source.kind]}; leave {_flag(given[0])} out"
        )
    if options.scan is not None and options.all_scans:
        raise UsageError("--scan and --all-scans: got both; expected one of them")
    if options.density is not None and not _is_lubricated(source):
        raise UsageError("--density: got a study without lubricant; expected one with a film; leave --density out")


def _flag(name):
    return "--" + name.replace("_", "-")


def _is_lubricated(study):
    return any(density > 0 for density in study.table.get("lubricant_density_g_per_m2", ()))
