// SPDX-License-Identifier: MIT
/// plumb export: makes a replay, a picture or a table of a recording, such as one that a crash left
/// behind.
#include "app/distinct_files.h"
#include "app/verbs.h"
#include "host/log.h"
#include "output/exporters.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace plumb::app {

Verb add_export(CLI::App& command) {
    struct Options {
        std::string recording;
        std::vector<std::string> files;
    };
    auto options = std::make_shared<Options>();
    command.add_option("recording", options->recording, "a .plumb file")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--out", options->files, "a .html, .png, .csv or .plumb file; may be repeated")
        ->required()
        ->type_name("FILE")
        ->allow_extra_args(false);
    return [options] {
        check_distinct(options->files, options->recording);
        const Recording recording = read_recording(options->recording);
        if (recording.dropped_bytes > 0)
            logger()->warn("{}: the last {} bytes are no whole frame and are left out",
                           options->recording, recording.dropped_bytes);
        for (const std::string& file : options->files) export_recording(file, recording);
        std::printf("%s: %zu frames\n", options->recording.c_str(), recording.frames.size());
        return static_cast<int>(kDone);
    };
}

}  // namespace plumb::app
