"""Pictures of the pages on theory, oil, films under load, tools and filters."""

import numpy as np

import tabor as tb
from drawing import (MATERIAL, MPA, PERCENT, ROOT, UM, busiest_row, cut, draw_section, exaggeration_note, picture, reported, section_legend,
                     sheet, show_map)
from tabor.report import style

EXAMPLES = ROOT / "examples"
PART = (220, 340)  # columns of sections


@picture("theory_contact_area")
def theory_contact_area():
    """Area against load of a self-affine surface between the limits of theory, and with a cap."""
    slope, modulus = 0.1, 100e9
    surface = tb.generate("self-affine", pixels=512, pixel="1 um", rms_slope=slope, short_cutoff="32 um", seed=1)
    loads = np.geomspace(0.003, 0.5, 12)
    figure, axes = style.new_figure(3.2, width=5.6)
    axes = axes[0, 0]
    for cap, label, look in ((None, "elastic", "o-"), (0.03 * modulus, "saturation pressure 0.03 E*", "s-")):
        solid = tb.Solid(youngs_modulus=modulus, poissons_ratio=0, saturation_pressure=cap)
        pressures = [load * modulus * slope for load in loads if cap is None or load * modulus * slope < 0.95 * cap]
        areas = [one.area_fraction for one in tb.contact(surface, pressures, solid)]
        axes.loglog(np.array(pressures) / (modulus * slope), areas, look, markersize=4, label=label)
    lines = ((np.sqrt(2 * np.pi), r"light load, $\kappa = \sqrt{2\pi}$ (asperities)", ":"),
             (np.sqrt(8 / np.pi), r"light load, $\kappa = \sqrt{8/\pi}$ (Persson)", "--"), (slope / 0.03, "P / saturation pressure", "-."))
    for factor, label, dash in lines:
        light = loads[factor * loads <= 1]
        axes.loglog(light, factor * light, color="0.3", linestyle=dash, linewidth=0.9, label=label)
    for axis in (axes.xaxis, axes.yaxis):
        style.log_axis(axis)
    axes.set(xlabel="P / (E* rms slope)", ylabel="contact area / nominal area", ylim=(4e-3, 1.3))
    axes.legend(fontsize=7)
    return figure


@picture("lubrication_pools")
def lubrication_pools():
    surface = sheet()
    one = tb.contact(surface, "7 MPa", MATERIAL)
    row = busiest_row(one.touching, PART)
    figure, axes = style.plt.subplots(3, 1, figsize=(7.2, 5.4), sharex=True)
    shown = (("droplets, 0.05 g/m²", "0.05 g/m^2", "droplets"), ("droplets, 0.9 g/m²", "0.9 g/m^2", "droplets"),
             ("bottom-fill, 0.9 g/m²", "0.9 g/m^2", "bottom-fill"))
    for part, (title, density, model) in zip(axes, shown):
        draw_section(part, cut(one, row, PART, tb.rain(surface, density, model=model)))
        part.set_title(title)
    for part in axes[:2]:
        part.set_xlabel("")
    section_legend(axes[0])
    exaggeration_note(axes[0])
    return figure


@picture("ehl_impact")
def ehl_impact():
    solved = tb.ehl.impact(EXAMPLES / "09_ball_drop" / "safa_gohar.toml").solve(check=False)
    return reported(solved, "impact_profiles")


@picture("ehl_line_profile")
def ehl_line_profile():
    solved = tb.ehl.line(EXAMPLES / "11_hdpe_glycerol" / "hdpe.toml").solve(check=False)
    return reported(solved, "line_profile")


@picture("ehl_point_film")
def ehl_point_film():
    case = tb.ehl.point(EXAMPLES / "12_stribeck" / "ball.toml", **{"motion.speed": "1 m/s"})
    return reported(case.solve(check=False), "point_film")


@picture("rough_tool_section")
def rough_tool_section():
    surface = sheet()
    film = tb.rain(surface, "0.45 g/m^2")
    flat = tb.contact(surface, "7 MPa", MATERIAL)
    tool = tb.contact(surface, "7 MPa", MATERIAL, tool="ground:Sa=0.1um")
    row = busiest_row(tool.touching & (film.thickness > 0), PART)
    figure, axes = style.plt.subplots(2, 1, figsize=(7.2, 4.6), sharex=True, sharey=True)
    for part, one, title in ((axes[0], flat, "under a flat"), (axes[1], tool, "under a ground tool, Sa = 0.1 µm")):
        draw_section(part, cut(one, row, PART, film))
        wet = PERCENT * tb.friction(one, film).lubricated_share
        part.set_title(f"{title}: {wet:.1f} % of the contact is wet")
    axes[0].set_xlabel("")
    section_legend(axes[1])
    return figure


@picture("trapped_liquid_pockets")
def trapped_liquid_pockets():
    surface = sheet()
    one = tb.contact(surface, "10 MPa", MATERIAL)
    found = tb.friction(one, tb.rain(surface, "0.45 g/m^2"), trapped=True, boundary_shear_strength="5 MPa")
    first, last = PART
    window = (slice(first, last), slice(first, last))
    part = surface[window]
    figure, axes = style.plt.subplots(1, 2, figsize=(7.6, 3.3))
    for axis, values, label, colours in ((axes[0], found.contact.pressure, "solids, no oil (MPa)", "Greys"),
                                         (axes[1], found.liquid_pressure, "oil in pockets (MPa)", "YlGnBu")):
        show_map(axis, part, np.where(values[window] > 0, MPA * values[window], np.nan), label, cmap=colours, vmin=0, vmax=240)
    axes[1].set_ylabel("")
    return figure


@picture("filters_section")
def filters_section():
    surface = sheet()
    filters = (("as measured", surface, "0.6"), ("gauss:8um", surface.lowpass("gauss:8um"), style.COLOURS[1]),
               ("hann:4.5um", surface.lowpass("hann:4.5um"), style.COLOURS[0]))
    figure, axes = style.plt.subplots(1, 2, figsize=(8.0, 3.0), width_ratios=(1.4, 1))
    row, columns = 256, slice(*PART)
    for name, one, colour in filters:
        axes[0].plot(UM * one.x[columns], UM * one.height[row, columns], color=colour, linewidth=1.1, label=name)
        radial = one.psd(window="hann").radial
        axes[1].loglog(UM * 2 * np.pi / radial.q, 1e24 * radial.density, color=colour, linewidth=1.1, label=name)
    axes[0].set(xlabel="$x$ (µm)", ylabel="height (µm)", title="one row")
    axes[1].set(xlabel="wavelength (µm)", ylabel="$C_{2D}$ (µm$^4$)", title="radial spectrum", ylim=(1e-12, None))
    axes[1].invert_xaxis()
    style.log_axis(axes[1].xaxis)
    axes[0].legend()
    return figure
