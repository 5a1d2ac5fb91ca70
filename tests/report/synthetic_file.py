"""Root attributes, NXdata groups and maps of docs/results.md."""

import h5py


def new_file(path):
    file = h5py.File(path, "w")
    file.attrs.update(
        {
            "format": "tabor",
            "format_version": 1,
            "software_version": "0.1.0",
            "command": "tabor sweep study.toml",
            "config_toml": 'shear_strength = "70 MPa"\n',
            "created": "2026-01-02T03:04:05Z",
            "default": "surface",
        }
    )
    return file


def add_nxdata(file, name, signal):
    group = file.create_group(name)
    group.attrs.update({"NX_class": "NXdata", "signal": signal, "axes": ["y", "x"]})
    return group


def add_map(group, name, values, unit, long_name):
    dataset = group.create_dataset(name, data=values, compression="gzip", compression_opts=4, shuffle=True)
    dataset.attrs.update({"units": unit, "long_name": long_name})
