# SPDX-License-Identifier: MIT
# What find_package(limpid) finds. Nothing in it depends on the architecture.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(limpid_package_dir "${CMAKE_INSTALL_DATADIR}/cmake/limpid")

install(TARGETS limpid EXPORT limpid-targets FILE_SET HEADERS)
install(EXPORT limpid-targets NAMESPACE limpid:: DESTINATION "${limpid_package_dir}")

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/limpid-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/limpid-config.cmake" INSTALL_DESTINATION "${limpid_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/limpid-config-version.cmake" COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/limpid-config.cmake" "${PROJECT_BINARY_DIR}/limpid-config-version.cmake"
        DESTINATION "${limpid_package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/udev/60-limpid-usb.rules" DESTINATION "${CMAKE_INSTALL_DATADIR}/limpid")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
