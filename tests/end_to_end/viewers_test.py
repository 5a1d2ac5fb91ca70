"""Results in programs that show them: silx and VTK, the library of ParaView, where these are installed (PyPI, or the Debian packages
python3-silx and python3-vtk9). TABOR=PROGRAM PYTHON viewers_test.py runs it with another interpreter."""

import unittest

from program import SOURCE, ProgramTest

try:
    import h5py
    import numpy as np
except ImportError:
    h5py = None
try:
    import silx.io
    from silx.io import nxdata
except ImportError:
    silx = None
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkDataArray
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader
except ImportError:
    vtkXMLImageDataReader = None

CONTACT = ("--pressure", "5MPa,9MPa", "--youngs-modulus", "70GPa", "--poisson-ratio", "0.33")


class Viewers(ProgramTest):
    def made(self, *words):
        done = self.tabor(*words)
        self.assertEqual(done.returncode, 0, done.stderr)

    def setUp(self):
        super().setUp()
        # Neither square pixels nor a square map: what is turned or mirrored is seen.
        np.savetxt(self.folder / "scan.txt", np.random.default_rng(7).normal(size=(12, 20)))
        self.made("convert", "scan.txt", "scan.h5", "--pixel", "1um,2um", "--unit", "um")


@unittest.skipIf(h5py is None or silx is None, "needs silx (PyPI)")
class Silx(Viewers):
    def default_plot(self, name):
        with silx.io.open(str(self.folder / name)) as file:
            found = nxdata.get_default(file)
            self.assertIsNotNone(found, f"{name}: no default plot")
            self.assertTrue(found.is_valid)
            axes = [axis[()] for axis in found.axes]
            return found.signal.name, found.signal_name, found.signal[()], found.axes_names, axes

    def test_a_scan_is_its_heights_over_y_and_x(self):
        name, title, values, axes, places = self.default_plot("scan.h5")
        self.assertEqual((name, title), ("/surface/height", "height, asperities up"))
        self.assertEqual(axes, ["y, downwards", "x, sliding direction"])
        with h5py.File(self.folder / "scan.h5") as file:
            np.testing.assert_array_equal(values, file["surface/height"][()])
        np.testing.assert_allclose(places[0], 2e-6 * (np.arange(12) + 0.5), rtol=1e-12)
        np.testing.assert_allclose(places[1], 1e-6 * (np.arange(20) + 0.5), rtol=1e-12)

    def test_a_result_is_a_surface_and_each_state_a_plot_of_its_own(self):
        self.made("contact", "scan.h5", *CONTACT, "-o", "contact.h5")
        self.assertEqual(self.default_plot("contact.h5")[0], "/surface/height")
        with silx.io.open(str(self.folder / "contact.h5")) as file:
            found = nxdata.NXdata(file["states/0001"])
            self.assertTrue(found.is_valid)
            np.testing.assert_array_equal(found.signal[()], file["states/0001/pressure"][()])

    def test_spectra_are_curves_on_logarithmic_axes(self):
        self.made("psd", "scan.h5", "-o", "one.h5")
        self.made("psd", "scan.h5", "scan.h5", "--group", "all=*", "-o", "two.h5")
        for name, group in (("one.h5", "/curves"), ("two.h5", "/scans/0000")):
            signal, _, values, _, places = self.default_plot(name)
            self.assertEqual(signal, f"{group}/psd_radial_m4")
            self.assertEqual(len(values), len(places[0]))
            with silx.io.open(str(self.folder / name)) as file:
                style = nxdata.NXdata(file[group]).plot_style
                self.assertEqual((style.signal_scale_type, style.axes_scale_types[-1]), ("log", "log"))

    def test_films_are_maps_profiles_and_histories(self):
        self.made("ehl", "point", SOURCE / "examples/12_stribeck/ball.toml", "-o", "point.h5")
        signal, _, values, _, places = self.default_plot("point.h5")
        self.assertEqual((signal, values.shape), ("/contact/film", (len(places[0]), len(places[1]))))
        self.made("ehl", "impact", SOURCE / "examples/10_restitution_map/ball.toml", "-o", "impact.h5")
        self.assertEqual(self.default_plot("impact.h5")[0], "/history/force")
        self.made("ehl", "line", SOURCE / "examples/11_hdpe_glycerol/hdpe.toml", "-o", "line.h5")
        self.assertEqual(self.default_plot("line.h5")[0], "/profile/film")


@unittest.skipIf(h5py is None or vtkXMLImageDataReader is None, "needs vtk (PyPI)")
class Vtk(Viewers):
    def read(self, name):
        """(image, {name of a map: (values with row 0 on top, unit)})"""
        reader = vtkXMLImageDataReader()
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        image = reader.GetOutput()
        nx, ny, nz = image.GetDimensions()
        self.assertEqual(nz, 1)
        arrays = [image.GetPointData().GetArray(place) for place in range(image.GetPointData().GetNumberOfArrays())]
        unit = vtkDataArray.UNITS_LABEL()
        # Points of VTK run upwards along y.
        return image, {array.GetName(): (vtk_to_numpy(array).reshape(ny, nx)[::-1], array.GetInformation().Get(unit)) for array in arrays}

    def assert_lies(self, image, spacing, first):
        np.testing.assert_allclose(image.GetSpacing()[:2], spacing, rtol=1e-12)
        np.testing.assert_allclose(image.GetPoint(0)[:2], first, rtol=1e-9)

    def test_all_states_have_values_units_and_places(self):
        self.made("contact", "scan.h5", *CONTACT, "-o", "contact.h5")
        self.made("contact", "scan.h5", *CONTACT, "-o", "direct.vti")
        self.made("convert", "contact.h5", "made.vti", "--field", "all", "--state", "all")
        for name in ("direct.vti", "made.vti"):
            image, maps = self.read(name)
            self.assertEqual(image.GetDimensions(), (20, 12, 1))
            self.assert_lies(image, (1e-6, 2e-6), (0.5e-6, 1e-6))
            with h5py.File(self.folder / "contact.h5") as file:
                for member, unit in (("gap", "m"), ("pressure", "Pa")):
                    for state in ("0000", "0001"):
                        values, shown = maps[f"{member}_{state}"]
                        np.testing.assert_array_equal(values, file[f"states/{state}/{member}"][()])
                        self.assertEqual(shown, unit)
                np.testing.assert_array_equal(maps["height"][0], file["surface/height"][()])

    def test_a_pixel_lies_where_the_scan_has_it(self):
        self.made("convert", "scan.h5", "scan.vti")
        image, maps = self.read("scan.vti")
        # Row 1, column 3 of 12 rows: 10.5 pixels of 2 um above the lower edge.
        place = image.FindPoint(3.5e-6, 21e-6, 0)
        value = image.GetPointData().GetArray("height").GetTuple1(place)
        self.assertEqual(value, maps["height"][0][1, 3])
        with h5py.File(self.folder / "scan.h5") as file:
            self.assertEqual(value, file["surface/height"][1, 3])

    def test_a_film_lies_about_the_centre_of_its_contact(self):
        self.made("ehl", "point", SOURCE / "examples/12_stribeck/ball.toml", "-o", "point.h5")
        self.made("convert", "point.h5", "point.vti", "--field", "all")
        image, maps = self.read("point.vti")
        with h5py.File(self.folder / "point.h5") as file:
            contact = file["contact"]
            x, y = contact["x"][()], contact["y"][()]
            np.testing.assert_array_equal(maps["film_thickness"][0], contact["film"][()])
            np.testing.assert_array_equal(maps["pressure"][0], contact["pressure"][()])
        self.assertEqual(maps["film_thickness"][1], "m")
        self.assert_lies(image, (x[1] - x[0], y[1] - y[0]), (x[0], y[0]))


if __name__ == "__main__":
    unittest.main()
