// SPDX-License-Identifier: MIT
#include "app/study_options.h"

#include "app/usage.h"
#include "app/verbs.h"
#include "host/log.h"
#include "math/fnv1a.h"
#include "output/file.h"
#include "reader/reader.h"
#include "scene/nearest.h"
#include "study/cases.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace plumb::app {
namespace {

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const study::CaseEntry& c : study::cases()) names.emplace_back(c.name);
    return names;
}

/// Hash of a file's bytes, as text.
std::string fingerprint(const std::string& bytes) {
    Fnv1a hash;
    hash.add(bytes.data(), bytes.size());
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
    return text;
}

}  // namespace

double seconds_of(std::string_view text, const std::string& option) {
    const std::string copy(text);
    char* end = nullptr;
    const double value = std::strtod(copy.c_str(), &end);
    const std::string unit(end);
    const double scale = unit.empty() || unit == "s" ? 1
                         : unit == "m"               ? 60
                         : unit == "h"               ? 3600
                                                     : 0;
    if (end == copy.c_str() || scale == 0 || !(value > 0) || !(value < 1e9))
        throw UsageError(option + " " + copy + ": must be a time, such as 90s, 5m or 1h");
    return value * scale;
}

study::Subject subject_named(const std::string& name, const ColliderLibrary& colliders,
                             const study::ReferenceOptions& references) {
    if (const study::CaseEntry* entry = study::find_case(name)) return entry->make();
    const std::filesystem::path file(name);
    if (!std::filesystem::exists(file) && file.extension().empty())
        throw UsageError(name + ": is neither a case nor a scene's file" +
                         advice(name, case_names()) + "; plumb cost --list names the cases");
    const Scene scene = read_scene(file);
    study::Subject subject =
        study::self_referenced(scene, file.stem().string(), colliders, references);
    subject.fingerprint = fingerprint(read_file(name));
    return subject;
}

void choose_metric(study::Subject& subject, const std::string& metric) {
    std::vector<std::string> names;
    for (const study::Metric& m : subject.metrics) names.push_back(m.name);
    const auto found = std::find(names.begin(), names.end(), metric);
    if (found == names.end()) {
        std::string list;
        for (const std::string& n : names) list += (list.empty() ? "" : ", ") + n;
        throw UsageError("--metric " + metric + ": " + subject.name + " has " + list +
                         advice(metric, names));
    }
    if (found == names.begin()) return;
    const auto first = subject.metrics.begin();
    std::rotate(first, first + (found - names.begin()), first + (found - names.begin()) + 1);
    subject.tolerance = subject.horizon = 0;
    subject.orders = {};
}

int with_references(const std::function<int()>& verb) {
    try {
        return verb();
    } catch (const study::NoReference& e) {
        logger()->error(e.what());
        if (e.reason == study::NoReference::stopped) return kInterrupted;
        return e.reason == study::NoReference::runs_off ? kDiverged : kUsage;
    }
}

}  // namespace plumb::app
