# Copyright Spack Project Developers. See COPYRIGHT file for details.
#
# SPDX-License-Identifier: (Apache-2.0 OR MIT)

from spack.package import *


class Tabor(CMakePackage):
    """Real contact area, lubricant and friction of scanned rough surfaces: the program and the C++ library."""

    license("BSD-3-Clause")

    # No release has an archive yet: `spack dev-build tabor@main` builds a clone.
    version("main")

    # Spack compiles for a target of its own choice, which its compiler wrappers add.
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("python@3.11:", type=("build", "run"))
    depends_on("eigen@3.4")
    depends_on("fftw@3.3: precision=float,double")
    depends_on("fmt")
    depends_on("hdf5@1.10: +hl~mpi")
    depends_on("libdeflate")
    depends_on("libpng")
    depends_on("libtiff")
    depends_on("libzip")
    depends_on("nlohmann-json")
    depends_on("openssl")
    depends_on("pugixml")
    depends_on("libyaml")
    depends_on("tomlplusplus")
    depends_on("zlib-api")
    depends_on("py-h5py", type="run")
    depends_on("py-jinja2", type="run")
    depends_on("py-matplotlib", type="run")

    conflicts("%gcc@:11", msg="tabor needs C++20")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("TABOR_PROCESSORS", "any"),
            self.define("TABOR_TESTS", False),
            self.define("TABOR_BENCHMARKS", False),
            self.define("TABOR_PRECOMPILED", True),
            self.define("TABOR_UNITY", True),
        ]
