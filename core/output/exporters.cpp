// SPDX-License-Identifier: MIT
#include "output/exporters.h"

#include "output/csv.h"
#include "output/error.h"
#include "output/html.h"
#include "output/png.h"
#include "scene/nearest.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <string_view>
#include <vector>

namespace plumb {
namespace {

/// A recording is an output like any other.
class PlumbExporter : public Exporter {
public:
    PlumbExporter(const std::string& path, const RecordingHeader& header) : writer_(path, header) {}
    void append(const Frame& frame) override { writer_.append(frame); }
    void finish() override { writer_.close(); }

private:
    RecordingWriter writer_;
};

using Maker = std::unique_ptr<Exporter> (*)(const std::string& path, const RecordingHeader& header);

template <class T>
std::unique_ptr<Exporter> make(const std::string& path, const RecordingHeader& header) {
    return std::make_unique<T>(path, header);
}

struct Kind {
    std::string_view extension;
    Maker maker;
};

constexpr std::array kKinds{
    Kind{".html", make<HtmlExporter>},
    Kind{".png", make<PngExporter>},
    Kind{".csv", make<CsvExporter>},
    Kind{".plumb", make<PlumbExporter>},
};

/// ".HTML" of "dir.d/run.HTML" in small letters; empty where the name has none.
std::string extension_of(const std::string& path) {
    const std::size_t name = path.find_last_of('/') + 1;  // npos + 1 is 0
    const std::size_t dot = path.find_last_of('.');
    if (dot == std::string::npos || dot < name) return {};
    std::string extension = path.substr(dot);
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

/// "has the ending .htm, and none of .html, .csv, .plumb; did you mean .html?"
std::string sentence_about(const std::string& extension) {
    std::vector<std::string> known;
    std::string list;
    for (const Kind& kind : kKinds) {
        known.emplace_back(kind.extension);
        list += (list.empty() ? "" : ", ") + known.back();
    }
    if (extension.empty()) return "has no ending; it must be one of " + list;

    const std::string near = nearest(extension, known);
    return "has the ending " + extension + ", which is none of " + list +
           (near.empty() ? "" : "; did you mean " + near + "?");
}

}  // namespace

std::unique_ptr<Exporter> make_exporter(const std::string& path, const RecordingHeader& header) {
    const std::string extension = extension_of(path);
    for (const Kind& kind : kKinds) {
        if (kind.extension == extension) return kind.maker(path, header);
    }
    throw UnknownEnding(path, sentence_about(extension));
}

std::unique_ptr<Exporter> make_exporter(const std::string& path, const Scene& scene,
                                        const Metadata& metadata) {
    return make_exporter(path, recording_header(scene, metadata));
}

void export_recording(const std::string& path, const Recording& recording) {
    const std::unique_ptr<Exporter> exporter = make_exporter(path, recording.header);
    for (const Frame& frame : recording.frames) exporter->append(frame);
    exporter->finish();
}

}  // namespace plumb
