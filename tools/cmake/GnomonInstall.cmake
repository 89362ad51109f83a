# SPDX-License-Identifier: Apache-2.0
# The installed library: headers, archives, and a package config for find_package(gnomon).
include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
install(TARGETS gnomon_text gnomon_scene gnomon_gpu gnomon_pipeline EXPORT gnomonTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION ${config_folder})
install(DIRECTORY include/gnomon ${PROJECT_BINARY_DIR}/include/gnomon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")

configure_package_config_file(tools/cmake/gnomonConfig.cmake.in ${PROJECT_BINARY_DIR}/gnomonConfig.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gnomonConfig.cmake ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
        DESTINATION ${config_folder})
