# What tools/demo builds, to run it once: `seqc build`, and `nanoplc-sim run` in virtual time with a JVL motor. It is not optimised, many
# files are compiled at once, and files that neither needs are left out.
set(NPLC_TOGETHER 30)
# Every other build checks fmt's format strings while it compiles.
add_compile_definitions(FMT_CONSTEVAL=)

# Of these modules only the files that match. A module without files keeps its headers.
set(NPLC_DEMO_hal_linux "^(files|process|terminal)\\.cpp$")
set(NPLC_DEMO_host "^(files|printable|text_file)\\.cpp$")
set(NPLC_DEMO_rehearsal "^names\\.cpp$")
set(NPLC_DEMO_analysis "^$")
set(NPLC_DEMO_sim_midi_drive "^$")
set(NPLC_DEMO_sim_midi_module "^$")
set(NPLC_DEMO_sim_motor_stage "^motor_")
set(NPLC_DEMO_protocol "^(fastmac|flexmac|mactalk|modbus_pdu|modbus_rtu)\\.cpp$")
set(NPLC_DEMO_seqc "explanation_texts|^(compile\\.cpp$|compiler/|diagnostics/explanations\\.cpp$|language/|lowering/|symbols/)|^report/(describe|line_time|listing|machine|render_all|set_points_text|table_report|table_text|written_text)\\.cpp$")

# nplc_demo_part(MODULE SOURCES)   reduces the module's list of files to those that are needed
function(nplc_demo_part name sources)
  set(needed ${${sources}})
  if(DEFINED NPLC_DEMO_${name})
    list(FILTER needed INCLUDE REGEX "${NPLC_DEMO_${name}}")
  endif()
  set(${sources} ${needed} PARENT_SCOPE)
endfunction()
