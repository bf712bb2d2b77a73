# find_package(voxtet): the targets voxtet::pipeline (all of the engine), voxtet::io, voxtet::geometry, ...
include(CMakeFindDependencyMacro)
find_dependency(ZLIB)
find_dependency(Threads)
find_path(VOXTET_EIGEN_DIR Eigen/Core PATH_SUFFIXES eigen3 REQUIRED)
find_path(VOXTET_JSON_DIR nlohmann/json.hpp REQUIRED)
include(${CMAKE_CURRENT_LIST_DIR}/voxtetTargets.cmake)
target_include_directories(voxtet::voxtet_headers SYSTEM INTERFACE ${VOXTET_EIGEN_DIR} ${VOXTET_JSON_DIR})
