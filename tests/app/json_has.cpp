// SPDX-License-Identifier: MIT
/// json_has FILE POINTER…: fails unless the file is JSON and has a value at each pointer.
/// json_has FILE --print POINTER: prints that value.
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

int main(int argc, char** argv) try {
    std::ifstream file(argc > 1 ? argv[1] : "");
    const auto json = nlohmann::json::parse(file);
    bool print = false;
    for (int i = 2; i < argc; ++i) {
        if (std::string(argv[i]) == "--print") {
            print = true;
            continue;
        }
        const auto& value = json.at(nlohmann::json::json_pointer(argv[i]));
        if (print) std::puts(value.dump().c_str());
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "json_has: %s\n", e.what());
    return 1;
}
