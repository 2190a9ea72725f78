# The families of drives that a gateway can lead, each with its part in these folders, in files named after it:
#
#   firmware/registers       FAMILY_family.cpp     models, names, registers, why an order is refused
#   firmware/motor           FAMILY_*.cpp          its driver; motor/FAMILY_driver.h makes it, on a serial line
#                                                  motor/FAMILY_can_driver.h, if there is one, on CAN
#   firmware/boards/linux    FAMILY_support.cpp    its keys in the configuration, its wiring
#   host-sim/board           FAMILY_virtual.cpp    its virtual drive
#
# The first family is the default.
set(NPLC_FAMILIES jvl midi)
if(NPLC_DEMO)
  set(NPLC_FAMILIES jvl)
endif()

# nplc_family_sources(OUT)           the families' files in this folder
# nplc_family_list(FOLDER NAME...)   writes family_list.h, which lists families by name for the compiler
function(nplc_family_sources out)
  set(found)
  foreach(family IN LISTS NPLC_FAMILIES)
    file(GLOB files CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" ${family}_*.cpp)
    list(APPEND found ${files})
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

function(nplc_family_list folder)
  set(includes)
  set(names)
  set(drivers)
  foreach(family IN LISTS ARGN)
    string(APPEND includes "#include \"motor/${family}_driver.h\"\n")
    string(APPEND names " X(${family})")
    list(APPEND drivers "nplc::motor::${family}::Driver")
    set(on_can "motor/${family}_can_driver.h")
    if(NPLC_HOSTED AND EXISTS "${CMAKE_SOURCE_DIR}/firmware/motor/include/${on_can}")
      string(APPEND includes "#include \"${on_can}\"\n")
      list(APPEND drivers "nplc::motor::${family}::CanDriver")
    endif()
  endforeach()
  list(JOIN drivers ", " drivers)
  file(CONFIGURE OUTPUT "${folder}/registers/family_list.h" CONTENT "#pragma once\n#define NPLC_FAMILIES(X)@names@\n" @ONLY)
  file(CONFIGURE OUTPUT "${folder}/motor/family_drivers.h" CONTENT
       "#pragma once\n@includes@#define NPLC_FAMILY_DRIVERS @drivers@\n" @ONLY)
endfunction()

set(NPLC_FAMILY_LIST "${CMAKE_BINARY_DIR}/families")
nplc_family_list("${NPLC_FAMILY_LIST}" ${NPLC_FAMILIES})
