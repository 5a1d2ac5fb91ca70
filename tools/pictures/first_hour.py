"""Pictures of docs/first_hour.md: one scan, from heights to friction and what not to trust."""

import pathlib
import shutil
import tempfile

import numpy as np

import tabor as tb
from drawing import (FILM_COLOURS, HEIGHT_COLOURS, MATERIAL, MPA, PERCENT, PRESSURE_COLOURS, ROOT, SHEET, UM, busiest_row, cut,
                     draw_section, exaggeration_note, picture, section_legend, sheet, show_map)
from tabor.report import style

ZOOM = (220, 340)  # columns and rows of the part that is shown large
DENSITIES = ("0.45 g/m^2", "0.9 g/m^2")


def _zoomed(surface):
    first, last = ZOOM
    return surface[first:last, first:last]


@picture("first_hour_level")
def level():
    before, after = tb.read(SHEET), sheet()
    figure, axes = style.plt.subplots(1, 3, figsize=(8.4, 2.7), width_ratios=(1, 1, 1.1))
    limits = (-4, 1.7)
    for part, surface, title in zip(axes, (before, after), ("as measured", "levelled by a plane")):
        heights = UM * (surface.height - surface.height.mean())
        show_map(part, surface, heights, "height (µm)" if part is axes[1] else None, cmap=HEIGHT_COLOURS, vmin=limits[0], vmax=limits[1])
        part.set_title(title)
    axes[1].set_ylabel("")
    columns = [UM * (surface.height - surface.height.mean()).mean(axis=0) for surface in (before, after)]
    looks = (("as measured", "0.6", "-"), ("levelled", style.COLOURS[0], "-"), ("plane, subtracted", style.WARNING, "--"))
    for line, (label, colour, dash) in zip((*columns, columns[0] - columns[1]), looks):
        axes[2].plot(UM * after.x, line, color=colour, linestyle=dash, label=label)
    axes[2].set(xlabel="$x$ (µm)", ylabel="mean height of a column (µm)", title="what the plane changes", ylim=(None, 2))
    axes[2].legend()
    return figure


@picture("first_hour_parameters")
def parameters():
    surface = sheet()
    found = surface.parameters(["Sa", "Sq", "Sk", "Spk", "Svk", "Smrk1", "Smrk2"])
    values = {key: float(one) for key, one in found.items()}
    heights = np.sort(UM * (surface.height - surface.height.mean()).ravel())[::-1]
    figure, axes = style.plt.subplots(1, 2, figsize=(7.2, 2.9), sharey=True)
    axes[0].hist(heights, bins=120, orientation="horizontal", color=style.SOLID)
    rms = UM * values["Sq"]
    axes[0].axhspan(-rms, rms, color=style.COLOURS[0], alpha=0.15, label=f"mean ± Sq, Sq = {rms:.2f} µm")
    axes[0].set(xlabel="number of pixels", ylabel="height above the mean (µm)", title="how high the pixels are")
    axes[0].legend(loc="lower right")
    _material_ratio(axes[1], heights, values)
    return figure


def _material_ratio(axes, heights, values):
    """The curve of material ratio with the core, which Sk is the height of."""
    ratio = PERCENT * (np.arange(heights.size) + 0.5) / heights.size
    axes.plot(ratio[::200], heights[::200], color="0.3")
    low, high = values["Smrk1"], values["Smrk2"]  # [%]
    core = UM * values["Sk"]
    top = np.interp(high, ratio, heights) + core  # the core's line ends at the height of Smrk2
    axes.plot((0, 100), (top, top - core), color=style.COLOURS[1], linewidth=1, linestyle="--")
    axes.axhspan(top - core, top, color=style.COLOURS[1], alpha=0.12, label=f"core, Sk = {core:.2f} µm")
    for at in (low, high):
        axes.axvline(at, color="0.6", linewidth=0.6)
    axes.set(xlabel="share of pixels above this height (%)", xlim=(0, 100), title="material ratio")
    axes.text(3, top + 0.15, f"peaks above: Spk = {UM * values['Spk']:.2f} µm", fontsize=8)
    axes.text(30, heights[-1] * 0.85, f"valleys below: Svk = {UM * values['Svk']:.2f} µm", fontsize=8)
    axes.legend(loc="lower left")


@picture("first_hour_spectrum")
def spectrum():
    surface = sheet()
    spectra = surface.psd()
    figure, axes = style.new_figure(3.1, width=5.6)
    axes = axes[0, 0]
    axes.set_xscale("log")
    axes.set_yscale("log")
    for one, label, colour in ((spectra.x, "along $x$", style.COLOURS[1]), (spectra.y, "along $y$", style.COLOURS[0])):
        axes.plot(UM * 2 * np.pi / one.q, one.density * 1e18, color=colour, linewidth=1, label=f"{label}: H = {one.hurst:.2f} ± {one.hurst_standard_error:.2f}")
    side, pixel = min(surface.lengths), surface.dx
    axes.axvspan(4 * UM * pixel, UM * side / 4, color="0.5", alpha=0.12, linewidth=0, label="wavelengths to trust")
    axes.invert_xaxis()
    style.log_axis(axes.xaxis)
    axes.set(xlabel="wavelength (µm)", ylabel="power spectral density $C_{1D}$ (µm³)")
    axes.legend()
    return figure


def _pressed(pressure="7 MPa", **keywords):
    return tb.contact(sheet(), pressure, MATERIAL, **keywords)


@picture("first_hour_contact")
def contact():
    one = _pressed()
    part = _zoomed(one.surface)
    figure, axes = style.plt.subplots(1, 2, figsize=(7.6, 3.2), width_ratios=(1, 1.25))
    surface = one.surface
    show_map(axes[0], surface, one.touching, cmap="Greys", vmin=0, vmax=1)
    first, last = ZOOM
    corner, side = UM * surface.dx * first, UM * surface.dx * (last - first)
    axes[0].add_patch(style.plt.Rectangle((corner, corner), side, side, fill=False, color=style.WARNING))
    axes[0].set_title(f"black: solids touch, {PERCENT * one.touching.mean():.1f} % of the pixels")
    pressure = np.where(one.touching, MPA * one.pressure, np.nan)[first:last, first:last]
    show_map(axes[1], part, UM * part.height, cmap="Greys_r", alpha=0.5)
    show_map(axes[1], part, pressure, "contact pressure (MPa)", cmap=PRESSURE_COLOURS, vmin=0, vmax=240)
    axes[1].set_title("the red square, over its heights")
    axes[1].set_ylabel("")
    return figure


@picture("first_hour_sweep")
def sweep():
    surface = sheet()
    pressures = np.geomspace(1e6, 100e6, 9)
    aluminium = tb.Solid(MATERIAL)
    elastic = tb.Solid(MATERIAL, saturation_pressure="none")
    figure, axes = style.new_figure(3.1, width=5.6)
    axes = axes[0, 0]
    for solid, label, look in ((aluminium, "counted contact, yields at 240 MPa", "o-"), (elastic, "counted contact, elastic", "s-")):
        areas = [PERCENT * one.touching.mean() for one in tb.contact(surface, pressures, solid)]
        axes.loglog(MPA * pressures, areas, look, markersize=4, label=label)
    axes.loglog(MPA * pressures, PERCENT * pressures / aluminium.saturation_pressure, "k--", linewidth=0.9, label="pressure / saturation pressure")
    for axis in (axes.xaxis, axes.yaxis):
        style.log_axis(axis)
    axes.set(xlabel="mean pressure (MPa)", ylabel="share of the area (%)")
    axes.legend()
    return figure


@picture("first_hour_oil")
def oil():
    one = _pressed()
    film = tb.rain(one.surface, DENSITIES[1])
    figure, axes = style.plt.subplots(1, 2, figsize=(8.4, 3.1), width_ratios=(1, 1.5))
    show_map(axes[0], one.surface, np.where(film.thickness > 0, UM * film.thickness, np.nan), "film (µm)", cmap=FILM_COLOURS, vmin=0)
    axes[0].set_facecolor("#E8DCC8")
    axes[0].set_title(f"oil on {PERCENT * film.wet_fraction:.1f} % of the sheet")
    row = busiest_row(one.touching, ZOOM)
    draw_section(axes[1], cut(one, row, ZOOM, film))
    exaggeration_note(axes[1])
    axes[1].set_title(f"$y$ = {UM * one.surface.y[row]:.0f} µm")
    section_legend(axes[1])
    return figure


@picture("first_hour_friction")
def friction():
    figure, axes = style.new_figure(3.2, width=5.8)
    axes = axes[0, 0]
    pressures = ("2 MPa", "7 MPa", "15 MPa")
    contacts = [_pressed(one) for one in pressures]
    curves = tb.density_curve(contacts, density=DENSITIES)
    for curve, pressure, colour in zip(curves, pressures, style.sequence(3)[::-1]):
        axes.semilogx(1e3 * curve.lubricant_density, curve.friction_lubricated, color=colour, label=pressure)
    film = tb.rain(contacts[0].surface, DENSITIES)
    for one, colour in zip(contacts, style.sequence(3)[::-1]):
        found = [tb.friction(one, each).lubricated for each in film]
        axes.plot((0.45, 0.9), found, "o", color=colour, markersize=4)
    axes.axhline(70 / 240, color="0.4", linestyle="--", linewidth=0.8, label="dry limit, 70 MPa / 240 MPa")
    style.log_axis(axes.xaxis)
    axes.set(xlabel="oil on the sheet (g/m²)", ylabel="friction coefficient", ylim=(0, 0.33), xlim=(1e-3, 3))
    axes.legend(title="mean pressure", loc="lower left")
    return figure


@picture("first_hour_error_bars")
def error_bars():
    rows, averages = _four_sheets()
    figure, axes = style.new_figure(3.0, width=5.6)
    axes = axes[0, 0]
    for key, label, colour, marker in (("friction_dry", "dry", style.DRY, "s"), ("friction_lubricated", "0.45 g/m²", style.LIQUID, "o")):
        axes.plot([MPA * row["mean_pressure_Pa"] for row in rows], [row[key] for row in rows], ".", color=colour, alpha=0.5, markersize=4)
        mean, spread = ([row[f"{key}_{word}"] for row in averages] for word in ("mean", "std"))
        axes.errorbar([MPA * row["mean_pressure_Pa"] for row in averages], mean, spread, color=colour, marker=marker, capsize=3, label=label)
    axes.set(xlabel="mean pressure (MPa)", ylabel="friction coefficient", xlim=(0, None))
    axes.legend(title="mean ± standard deviation of 4 sheets")
    return figure


def _four_sheets():
    """Rows and averages of example 16."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "sheets").mkdir()
        for seed in (2, 3, 4, 5):
            tb.generate("edt", pixels=256, seed=seed).save(folder / "sheets" / f"{seed}.x3p")
        study = shutil.copy(ROOT / "examples" / "16_four_sheets" / "study.toml", folder)
        results = tb.Study.read(study).run(folder / "results")
        return results.rows, results.averages


@picture("first_hour_trust")
def trust():
    figure, axes = style.plt.subplots(2, 2, figsize=(7.6, 5.2))
    _pixel_size(axes[0, 0])
    _clamp(axes[0, 1])
    _spill_over(axes[1, 0])
    _edges(axes[1, 1])
    return figure


def _pixel_size(axes):
    """The wet share with averaged pixels."""
    surface = sheet()
    sides, shares = [], []
    for step in (1, 2, 4):
        coarse = surface if step == 1 else surface.resample(f"{surface.shape[1] // step},{surface.shape[0] // step}")
        found = tb.friction(tb.contact(coarse, "7 MPa", MATERIAL), tb.rain(coarse, DENSITIES[0]))
        sides.append(UM * coarse.dx)
        shares.append(PERCENT * found.lubricated_share)
    axes.plot(sides, shares, "o-", color=style.LIQUID)
    axes.set(xlabel="side of a pixel (µm)", ylabel="wet share of the contact (%)", title="pixel size: not a property of the sheet", ylim=(0, None), xlim=(0, None))


def _clamp(axes):
    """Dry friction of three surfaces against the saturation pressure."""
    caps = np.geomspace(120e6, 4e9, 8)
    for factor, colour in zip((0.5, 1, 2), style.sequence(3)):
        surface = factor * sheet()
        dry = [_dry_friction(surface, cap) for cap in caps]
        axes.loglog(MPA * caps, dry, "o-", color=colour, markersize=3, label=f"heights × {factor:g}")
    axes.loglog(MPA * caps, 70e6 / caps, "k--", linewidth=0.9, label="70 MPa / saturation pressure")
    for axis in (axes.xaxis, axes.yaxis):
        style.log_axis(axis)
    axes.set(xlabel="saturation pressure (MPa)", ylabel="dry friction", title="clamp: the material, not the surface")
    axes.legend(fontsize=7)


def _dry_friction(surface, cap):
    pressed = tb.contact(surface, "7 MPa", tb.Solid(MATERIAL, saturation_pressure=cap))
    return pressed.touching.mean() * 70e6 / pressed.mean_pressure


def _spill_over(axes):
    densities = np.geomspace(0.2e-3, 3e-3, 9)
    one = _pressed()
    share = [PERCENT * tb.friction(one, film).values["spill_over_fraction"] for film in tb.rain(one.surface, list(densities))]
    axes.loglog(1e3 * densities, share, "o-", color=style.LIQUID, markersize=4)
    axes.axhline(5, color=style.WARNING, linewidth=0.9, linestyle="--", label="tabor warns from here on")
    for axis in (axes.xaxis, axes.yaxis):
        style.log_axis(axis)
    axes.set(xlabel="oil on the sheet (g/m²)", ylabel="oil that no longer fits (%)", title="spill-over: oil that goes somewhere")
    axes.legend(fontsize=7)


def _edges(axes):
    """Counted contact of a smoothed quarter of the sheet with each reading of its edges."""
    piece = sheet().crop(0, 256, 256, 256).level("plane").lowpass("gauss:16um")
    elastic = tb.Solid(MATERIAL, saturation_pressure="none")
    names = ("tile", "cut", "end")
    areas = [PERCENT * tb.contact(piece, "7 MPa", elastic, edges=name).touching.mean() for name in names]
    axes.bar(names, areas, color=style.COLOURS[:3], width=0.6)
    for at, area in enumerate(areas):
        axes.text(at, area, f"{area:.2f} %", ha="center", va="bottom", fontsize=8)
    axes.set(ylabel="counted contact, elastic (%)", title="edges: what lies beyond a quarter of the scan")
