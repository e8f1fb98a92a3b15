// SPDX-License-Identifier: MIT
/// What plumb cost and plumb tune have in common: subjects by name or file, and the time they may
/// take.
#pragma once

#include "host/collider_library.h"
#include "study/self_reference.h"
#include "study/subject.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::app {

/// "90", "90s", "5m", "1h" as seconds. Throws UsageError, naming the option, for anything else.
double seconds_of(std::string_view text, const std::string& option);

/// The case of this name, or the scene of this file, which is measured against finer runs of
/// itself, made as the options say. Throws UsageError for a name that is neither.
study::Subject subject_named(const std::string& name, const ColliderLibrary& colliders,
                             const study::ReferenceOptions& references);

/// Runs a verb of the study; what leaves a scene without a reference gets its sentence and code.
int with_references(const std::function<int()>& verb);

/// Puts the metric of this name first. Throws UsageError where the subject has none.
void choose_metric(study::Subject& subject, const std::string& metric);

}  // namespace plumb::app
