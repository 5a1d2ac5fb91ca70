"""What results offer in a notebook: masks, patches, pictures, short texts, names."""

import pickle

import numpy as np
import pytest

import tabor as tb


@pytest.fixture(scope="module")
def contact():
    surface = tb.generate("edt", pixels=64, seed=2)
    return tb.contact(surface, "20 MPa", "aluminium-6016")


@pytest.fixture(scope="module")
def film(contact):
    return tb.rain(contact.surface, "0.9 g/m^2")


@pytest.fixture(scope="module")
def swept():
    case = tb.ehl.squeeze(tb.ehl.template("squeeze"))
    return case.sweep({"lubricant.viscosity": [0.2, 0.4, 2.0], "roller.speed": ["0.5 m/s", "1 m/s"]}, check=False)


def test_masks_are_those_of_the_numbers(contact):
    assert contact.touching.dtype == contact.saturated.dtype == bool and contact.touching.shape == contact.pressure.shape
    np.testing.assert_array_equal(contact.touching, contact.pressure > 0)
    assert contact.touching.mean() == pytest.approx(contact.values["contact_area_fraction_pixels"], rel=1e-12)
    assert contact.saturated.mean() == pytest.approx(contact.values["saturated_area_fraction"], rel=1e-12)
    assert 0 < contact.saturated.sum() < contact.touching.sum() and (contact.touching | ~contact.saturated).all()


def test_patches_have_numbers(contact):
    patches = contact.patches
    np.testing.assert_array_equal(patches > 0, contact.touching)
    assert patches.max() == contact.values["n_patches"] and patches.dtype == np.int32
    assert (np.bincount(patches.ravel())[1:] > 0).all()


def test_force_and_highest_pressure(contact):
    lx, ly = contact.surface.lengths
    assert contact.force == pytest.approx(contact.pressure.sum() * contact.surface.dx * contact.surface.dy, rel=1e-9)
    assert contact.force == pytest.approx(2e7 * lx * ly) and contact.max_pressure == contact.pressure.max()


def test_wet_contact_is_the_wet_share(contact, film):
    for dry_below in (0, "100 nm"):
        friction = tb.friction(contact, film, dry_below=dry_below)
        assert friction.wet.sum() / contact.touching.sum() == pytest.approx(friction.lubricated_share, rel=1e-12)
        assert (contact.touching | ~friction.wet).all()


def test_masks_do_not_change(contact, film):
    for mask in (contact.touching, contact.saturated, contact.patches, tb.friction(contact, film).wet):
        with pytest.raises(ValueError, match="read-only"):
            mask[:] = 0


@pytest.mark.parametrize("field, unit, factor", [("pressure", "[MPa]", 1e-6), ("gap", "[µm]", 1e6), ("displacement", "[µm]", 1e6), ("touching", "touching", 1),
                                                 ("patches", "patch", 1)])
def test_maps_of_a_contact_are_drawn(contact, field, unit, factor):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    figure, ax = pyplot.subplots()
    assert contact.plot(field, ax, cmap="gray") is ax
    np.testing.assert_allclose(ax.images[0].get_array(), factor * getattr(contact, field))
    assert unit in figure.axes[1].get_ylabel() and len(figure.axes) == 2
    pyplot.close(figure)


def test_a_slider_has_one_colour_bar(contact, film):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    figure, ax = pyplot.subplots()
    friction = tb.friction(contact, film)
    for draw in (contact.plot, contact.plot, film.plot, friction.plot, contact.surface.plot):
        draw(ax=ax)
    assert len(figure.axes) == 2 and len(ax.images) == 1
    pyplot.close(figure)


def test_an_unknown_map_is_refused(contact, film):
    with pytest.raises(ValueError, match="field: got 'film'; expected one of pressure, displacement, gap"):
        contact.plot("film")
    with pytest.raises(ValueError, match="field: got 'mixed'; expected one of contact_pressure"):
        tb.friction(contact, film).plot("mixed")


def test_texts_are_short(contact, film, swept):
    curve = tb.density_curve(contact)
    for one in (contact.surface.psd(), contact.surface.psd().x, curve, contact, film, tb.friction(contact, film), swept,
                contact.surface.section((0, 0), (1e-5, 0)), contact.surface.parameters(["Sa"])):
        page = one._repr_html_()
        assert len(repr(one)) < 3000 and page.startswith("<div>") and "<table>" in page
    assert "plateau" in repr(curve) or curve.plateau is None


def test_spectra_and_curves_are_classes_with_names(contact):
    pytest.importorskip("xarray")
    spectra, curve = contact.surface.psd(), tb.density_curve(contact)
    for one in (spectra, curve):
        assert not isinstance(one, tuple)
        copy = pickle.loads(pickle.dumps(one))
        assert repr(copy) == repr(one)
        with pytest.raises(AttributeError):
            one.x = 1
    np.testing.assert_array_equal(curve.to_xarray().friction_lubricated.values, curve.friction_lubricated)
    np.testing.assert_array_equal(spectra.to_xarray().density_radial.values, spectra.radial.density)


def test_a_sweep_has_its_numbers_by_name(swept):
    np.testing.assert_array_equal(swept.min_film_m, swept["min_film_m"])
    assert "min_film_m" in dir(swept) and "min_film_m" in swept.keys() and swept.min_film_m.shape == (3, 2)
    with pytest.raises(KeyError) as raised:
        swept["film"]
    assert str(raised.value) == "Sweep has no 'film'; did you mean 'min_film_m', 'time_min_film_s'?"
    with pytest.raises(AttributeError, match="Sweep has no 'min_film'; did you mean 'min_film_m'"):
        swept.min_film


def test_a_sweep_is_drawn(swept):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    figure, ax = pyplot.subplots()
    swept.plot("min_film_m", ax)
    assert [len(line.get_xdata()) for line in ax.lines] == [3, 3] and ax.get_xscale() == "log"
    np.testing.assert_array_equal(ax.lines[1].get_ydata(), swept.min_film_m[:, 1])
    assert ax.get_xlabel() == "lubricant.viscosity [Pa s]" and "[m]" in ax.get_ylabel() and ax.get_legend().get_texts()[0].get_text().endswith(" m/s")
    with pytest.raises(ValueError, match="field: Sweep has no 'mu'"):
        swept.plot("mu")
    pyplot.close(figure)


def test_numbers_by_name_have_nearest_ones(contact, film):
    with pytest.raises(KeyError) as raised:
        contact.values["area_fraction"]
    assert "'contact_area_fraction'" in str(raised.value)
    assert dict(contact.values)["mean_pressure_Pa"] == contact.mean_pressure and len(contact.values) == len(list(contact.values))
    with pytest.raises(KeyError, match="mean_film_m"):
        film.values["mean_film"]
