// SPDX-License-Identifier: MIT
#include "app/residual_watch.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace plumb::app {

void ResidualWatch::add(const World& world, const StepReport& report) {
    end_ = report.residual;
    last_ = {};
    if (end_.islands == 0) return;
    last_ = {end_.worst, world.bodies.id[end_.worst.first_body], world.time};
    const double of_weight = last_.island.force_of_weight();
    if (steps_++ == 0 || of_weight > worst_.island.force_of_weight()) worst_ = last_;
    sum_ += of_weight;
    force_ = std::max(force_, end_.force);
    error_ = std::max(error_, end_.error);
}

nlohmann::ordered_json ResidualWatch::json() const {
    const double mean = steps_ > 0 ? sum_ / static_cast<double>(steps_) : 0;
    return {{"force_of_weight",
             {{"mean", mean},
              {"max", worst_.island.force_of_weight()},
              {"end", last_.island.force_of_weight()}}},
            {"force_n", {{"max", force_}, {"end", end_.force}}},
            {"error_m", {{"max", error_}, {"end", end_.error}}},
            {"island", json_of(worst_)},
            {"island_at_end", json_of(last_)}};
}

nlohmann::ordered_json ResidualWatch::json_of(const Seen& seen) {
    const IslandResidual& island = seen.island;
    if (island.bodies == 0) return nullptr;
    return {{"first_body", seen.first_body}, {"bodies", island.bodies},
            {"exact", island.exact},         {"weight_n", island.weight},
            {"force_n", island.force},       {"rms_force_n", island.rms_force},
            {"error_m", island.error},       {"time", seen.time}};
}

std::string ResidualWatch::in_words(const Settings& settings) const {
    if (worst_.island.bodies == 0) return "";
    const std::string how = worst_.island.exact
                                ? "solved exactly"
                                : "after " + std::to_string(settings.velocity_iterations) + " + " +
                                      std::to_string(settings.position_iterations) + " iterations";
    char text[160];
    std::snprintf(
        text, sizeof text,
        "worst island: %u bodies from body %u on, %.3g %% of its weight unbalanced %s, at "
        "%.2f s; %.3g %% at the end",
        worst_.island.bodies, worst_.first_body, 100 * worst_.island.force_of_weight(), how.c_str(),
        worst_.time, 100 * last_.island.force_of_weight());
    return text;
}

}  // namespace plumb::app
