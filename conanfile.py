# SPDX-License-Identifier: MIT
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy, load
from conan.tools.layout import basic_layout

required_conan_version = ">=2.0"


class Limpid(ConanFile):
    name = "limpid"
    description = "Control components for haptic rendering of slow, late and nonlinear virtual objects"
    license = "MIT"
    topics = ("haptics", "control", "prediction", "robotics", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    default_options = {"boost/*:header_only": True}
    exports_sources = "include/*", "udev/*", "LICENSE"
    no_copy_source = True
    test_package_folder = "test/conan"

    def set_version(self):
        text = load(self, os.path.join(self.recipe_folder, "CMakeLists.txt"))
        self.version = re.search(r"project\(\s*limpid\s+VERSION\s+([0-9.]+)", text).group(1)

    def layout(self):
        basic_layout(self)

    def requirements(self):
        self.requires("eigen/[>=3.4.0]", transitive_headers=True)
        self.requires("boost/[>=1.74.0]", transitive_headers=True)

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        copy(self, "*.rules", os.path.join(self.source_folder, "udev"), os.path.join(self.package_folder, "res"))
        copy(self, "*.hpp", os.path.join(self.source_folder, "include"), os.path.join(self.package_folder, "include"))

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread"]
        self.cpp_info.set_property("cmake_file_name", "limpid")
        self.cpp_info.set_property("cmake_target_name", "limpid::limpid")
