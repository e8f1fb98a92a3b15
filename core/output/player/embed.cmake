# Writes the C++ source SOURCE whose function player_script() returns the text of the file SCRIPT.
file(READ "${SCRIPT}" text)
string(FIND "${text}" ")plumb_player\"" delimiter)
if(NOT delimiter EQUAL -1)
  message(FATAL_ERROR "${SCRIPT} contains the delimiter of the literal that shall hold it")
endif()
file(WRITE "${SOURCE}" "// Generated from player.min.js.\n#include \"output/player.h\"\n\n"
  "namespace plumb {\n\nstd::string_view player_script() {\n    return R\"plumb_player(")
file(APPEND "${SOURCE}" "${text}")
file(APPEND "${SOURCE}" ")plumb_player\";\n}\n\n}  // namespace plumb\n")
