// SPDX-License-Identifier: MIT
/// Writes the JSON Schema of scenes to the file that is named on the command line.
#include <fstream>

#include "reader/reader.h"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    std::ofstream file(argv[1], std::ios::binary);
    file << plumb::scene_schema();
    return file.flush().good() ? 0 : 1;
}
