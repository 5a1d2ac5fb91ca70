"""From a result to figures on disk and the page."""

from pathlib import Path

from tabor.report import ehl, example, hdf, interactive, live_page, output, page, parameters, single, slide, spectra, study, style
from tabor.report.figures import (
    contact_area,
    contact_clusters,
    contact_map,
    density_friction,
    dry_friction,
    ehl_curves,
    ehl_impact,
    ehl_line,
    ehl_point,
    ehl_stribeck,
    heights,
    lubricant_map,
    lubricated_friction,
    mixed_friction,
    psd,
    single_curves,
    single_maps,
    slide_curves,
    slide_maps,
    slide_spectra,
    slides,
    topography,
)
from tabor.report.figures import parameters as groups
from tabor.report.figures import spectra as spectrum


def open_result(path):
    """A Study or a Single from a folder or file; raises InputError in one line."""
    path = hdf.file_of(path)
    if path.suffix == ".csv":
        return parameters.load(path)
    file = hdf.open_file(path)
    if ehl.is_ehl(file):
        return ehl.load(path, file)
    if spectra.is_one(file):
        return spectra.load(path, file)
    if "scans" in file or "table" in file:
        return study.load(path, file)
    return slide.load(path, file) if slide.is_one(file) else single.load(path, file)


def default_folder(source):
    """A study's figures lie in its folder; those of one file in a folder named after it."""
    if source.kind == "study":
        return source.path.parent
    return source.path.with_name(source.path.stem + "_report")


def build(source, folder, options, command):
    """Writes DIR/report.html, and DIR/figures/* where formats are asked for; returns the files' paths."""
    style.apply()
    folder = Path(folder)
    live = live_page.Live(source, options) if interactive.is_asked_for(options) else None
    if source.kind == "single":
        source.begin_numbers()  # figures are drawn meanwhile
    output.make_folder(folder / "figures" if options.figures else folder)
    shown, paths = [], []
    for drawn in _drawings(source, options, with_maps=bool(options.figures) or live is None):
        pictures = {form: style.picture(drawn.drawing, form) for form in options.figures}
        paths.extend(_save(folder / "figures", drawn, pictures))
        if options.html and not (live and drawn.is_viewed):
            shown.append(page.Shown.of(drawn, live, pictures))
        drawn.close()
    if options.html:
        output.write(folder / "report.html", page.render(source, shown, command, live))
        paths.append(folder / "report.html")
    return paths


def _drawings(source, options, with_maps):
    if source.kind == "study":
        return study_figures(source, options, with_maps)
    if source.kind == "params":
        return groups.draw(source)
    if source.kind == "psd":
        return spectrum.draw(source)
    if source.kind == "slide":
        return slide_figures(source, with_maps)
    return ehl_figures(source) if source.kind == "ehl" else single_figures(source, with_maps)


def ehl_figures(source):
    if source.is_sweep:
        return sweep_figures(source)
    programs = {
        "impact": ehl_impact.draw,
        "line": ehl_line.draw,
        "point": ehl_point.draw,
        "squeeze": ehl_curves.squeeze,
    }
    return programs[source.program](source)


def sweep_figures(source):
    if ehl_stribeck.is_one(source):
        yield from ehl_stribeck.draw(source)
    else:
        yield from ehl_curves.sweep(source)


def study_figures(source, options, with_maps=True):
    """Yields what can be drawn, in the order of the page, so that one figure is in memory at a time."""
    example.check(source, options)
    shown = example.examples(source, options) if with_maps else []
    for item in shown:
        yield from _surface(item)
    yield from _present(psd.draw(source))
    for item in shown:
        yield from _contact(item)
    yield from _present(contact_area.draw(source))
    yield from _present(dry_friction.draw(source, options.error_bar))
    for item in shown:
        yield from _present(lubricant_map.draw(item))
        yield from _present(contact_clusters.draw(item))
    yield from _present(lubricated_friction.draw(source, options.error_bar))
    yield from _present(density_friction.of_study(source, options.error_bar))
    yield from _present(mixed_friction.draw(source, options.error_bar))
    yield from _present(slides.draw(source))


def single_figures(source, with_maps=True):
    yield from _present(single_curves.draw(source))
    yield from _present(density_friction.of_single(source))
    yield from _present(heights.draw(source))
    if with_maps:
        heading = source.heading_of_heights if source.is_difference else None
        yield topography.draw(source.height(), source.pixel, "topography", source.title, zero=heading)
        yield from single_maps.draw(source)
    else:
        yield from single_maps.draw_beside_the_viewer(source)


def slide_figures(source, with_maps=True):
    yield from _present(slide_curves.draw(source))
    yield from _present(slide_spectra.draw(source))
    if with_maps:
        yield topography.draw(source.height(), source.pixel, "topography", f"{source.title}, before")
    yield from slide_maps.draw(source, with_maps)


def _surface(item):
    if item.height is not None:
        yield topography.draw(item.height, item.scan.pixel, "topography", item.scan.name, item.suffix)


def _contact(item):
    if item.contact is not None:
        yield contact_map.draw(
            item.state, item.scan.pixel, item.contact.facts, item.scan.name, suffix=item.suffix
        )


def _present(drawn):
    if drawn is not None:
        yield drawn


def _save(folder, drawn, pictures):
    """Writes the figure in each format, and its tables; nothing without a format."""
    files = {f"{drawn.name}.{form}": picture for form, picture in pictures.items()}
    if pictures:
        files.update({name: text() if callable(text) else text for name, text in drawn.tables().items()})
    for name, content in files.items():
        output.write(folder / name, content)
    return [folder / name for name in files]
