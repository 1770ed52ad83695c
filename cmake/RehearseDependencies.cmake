# Every dependency of Rehearse is a package of Debian 12; nothing is downloaded or vendored.
# The installed package includes this file too, so that a consumer finds the same ones.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(hwy 1.0 REQUIRED)
find_package(TBB REQUIRED)
find_package(NLopt REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(muparser REQUIRED IMPORTED_TARGET muparser)

# Optional: several processes under mpirun.
set(MPI_CXX_SKIP_MPICXX TRUE)
find_package(MPI QUIET COMPONENTS CXX)

find_path(REHEARSE_RANDOM123_INCLUDE_DIR NAMES Random123/philox.h REQUIRED)

# Kernel files are compiled for AVX2 (with fused multiply-add) and for AVX-512, and for nothing older: what has no fused
# multiply-add would round differently. core/processor.hpp refuses such processors.
if(NOT TARGET rehearse::highway)
  add_library(rehearse::highway INTERFACE IMPORTED)
  set_target_properties(rehearse::highway PROPERTIES
    INTERFACE_LINK_LIBRARIES hwy::hwy
    INTERFACE_COMPILE_DEFINITIONS HWY_BASELINE_TARGETS=HWY_AVX2)
endif()
