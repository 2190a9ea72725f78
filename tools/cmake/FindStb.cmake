# Stb::Stb, headers included as <stb/...>.
find_path(STB_INCLUDE stb/stb_image_write.h)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Stb REQUIRED_VARS STB_INCLUDE)
if(Stb_FOUND AND NOT TARGET Stb::Stb)
  add_library(Stb::Stb INTERFACE IMPORTED GLOBAL)
  target_include_directories(Stb::Stb SYSTEM INTERFACE "${STB_INCLUDE}")
endif()
