# Writes the C++ source SOURCE whose function NAME_script(), declared in output/NAME.h, returns the text of the file SCRIPT.
file(READ "${SCRIPT}" text)
string(FIND "${text}" ")plumb_script\"" delimiter)
if(NOT delimiter EQUAL -1)
  message(FATAL_ERROR "${SCRIPT} contains the delimiter of the literal that shall hold it")
endif()
get_filename_component(file "${SCRIPT}" NAME)
file(WRITE "${SOURCE}" "// Generated from ${file}.\n#include \"output/${NAME}.h\"\n\n"
  "namespace plumb {\n\nstd::string_view ${NAME}_script() {\n    return R\"plumb_script(")
file(APPEND "${SOURCE}" "${text}")
file(APPEND "${SOURCE}" ")plumb_script\";\n}\n\n}  // namespace plumb\n")
