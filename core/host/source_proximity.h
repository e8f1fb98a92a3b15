// SPDX-License-Identifier: MIT
/// A source of contacts as a collider: what lets a simulation run on a plugin in another process.
#pragma once

#include "host/contact_source.h"

#include <string>
#include <vector>

namespace plumb {

/// The source knows its bodies already, so that adding them again does nothing; once it was asked,
/// none come or go. A source that gives no more answers fails each detection with its sentence.
class SourceProximity final : public Proximity {
public:
    explicit SourceProximity(ContactSource& source) : source_(source) {}

    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return known(); }
    Status remove(std::uint32_t) noexcept override;
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return known(); }
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t sink_count) noexcept override;
    DetectStats stats() const noexcept override { return stats_; }

private:
    Status known() const;
    Status ask(const DetectRequest& request, const ContactSink& sink);

    ContactSource& source_;
    std::vector<Pose> poses_;
    DetectStats stats_{};
    std::string trouble_;
    bool asked_ = false;
};

}  // namespace plumb
