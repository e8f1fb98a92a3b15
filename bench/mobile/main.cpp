// SPDX-License-Identifier: MIT
/// bench_mobile [GREATEST_LEVEL [SECONDS]]: the mobile of 3 to 4095 joints (the paper's Figure 4),
/// on Plumb and on ODE's quick step in turn, one thread each.
///
/// One line of CSV for each: joints, name, median of a step's CPU time in the second half of the
/// run [ms], and the widest gap at its end [mm]; nan and nan where the state is no longer finite.
#include "mobile/contestants.h"
#include "peers/peer.h"

#include "host/simulation.h"
#include "measure/measure.h"
#include "reader/reader.h"

#include <ode/ode.h>

#include <unistd.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

namespace plumb::bench {
namespace {

/// Rods do not meet, so that no one is ever asked.
class NoCollider final : public Proximity {
public:
    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return {}; }
    Status remove(std::uint32_t) noexcept override { return {}; }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return {}; }
    Status detect(const DetectRequest&, const ContactSink*, std::uint32_t) noexcept override {
        return {};
    }
    DetectStats stats() const noexcept override { return {}; }
};

Scene mobile(int levels) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("mobile_" + std::to_string(getpid()) + ".json");
    std::ofstream(file) << R"({"name": "mobile", "settings": {"dt": 0.01},
        "bodies": [{"mobile": {"levels": )"
                        << levels << R"(, "spin": 0.5}}]})";
    const Scene scene = read_scene(file);
    std::filesystem::remove(file);
    return scene;
}

std::vector<Contestant> contestants(const Scene& scene) {
    const auto with = [&](JointMethod method, std::uint32_t substeps, std::uint32_t iterations,
                          const std::string& name) {
        Scene changed = scene;
        changed.settings.joints = method;
        changed.settings.substeps = substeps;
        changed.settings.position_iterations = iterations;
        return plumb_mobile(changed, name);
    };
    return {with(JointMethod::auto_, 1, 5, "Plumb trees"),
            ode_mobile(scene, 5),
            with(JointMethod::iterate, 1, 5, "Plumb iterated 5 times"),
            with(JointMethod::auto_, 5, 1, "Plumb trees in 5 substeps"),
            with(JointMethod::iterate, 5, 1, "Plumb iterated once in 5 substeps"),
            ode_mobile(scene, 50)};
}

void measure(int levels, double seconds) {
    const Scene scene = mobile(levels);
    std::vector<Contestant> all = contestants(scene);
    std::vector<std::vector<double>> times(all.size());
    const int steps = static_cast<int>(seconds / scene.settings.dt), turn = 25;
    for (int first = 0; first < steps; first += turn)
        for (std::size_t i = 0; i < all.size(); ++i)
            for (int k = first; k < std::min(first + turn, steps); ++k) {
                const double start = peer::now_ms();
                all[i].step();
                if (k >= steps / 2) times[i].push_back(peer::now_ms() - start);
            }
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double gap = all[i].gap();
        std::printf("%zu,%s,%.5f,%.3g\n", scene.joints.size(), all[i].name.c_str(),
                    std::isfinite(gap) ? peer::median(times[i]) : gap, gap * 1e3);
    }
    std::fflush(stdout);
}

}  // namespace

Contestant plumb_mobile(const Scene& scene, const std::string& name) {
    struct Run {
        NoCollider collider;
        Simulation simulation;
        bool finite = true;
        explicit Run(const Scene& s) : simulation(s, collider) {}
    };
    const auto run = std::make_shared<Run>(scene);
    return {name,
            [run] {
                if (run->finite) run->finite = run->simulation.step().finite;
            },
            [run] {
                if (!run->finite) return std::numeric_limits<double>::quiet_NaN();
                const std::vector<double> errors = joint_errors(run->simulation.world());
                return *std::max_element(errors.begin(), errors.end());
            }};
}

}  // namespace plumb::bench

int main(int argc, char** argv) {
    const int greatest = argc > 1 ? std::atoi(argv[1]) : 12;
    const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
    if (greatest < 2 || greatest > 16 || !(seconds > 0)) {
        std::fprintf(stderr, "usage: %s [GREATEST_LEVEL from 2 to 16 [SECONDS]]\n", argv[0]);
        return 2;
    }
    try {
        dInitODE2(0);
        std::puts("joints,name,step_ms,gap_mm");
        for (int levels = 2; levels <= greatest; ++levels) plumb::bench::measure(levels, seconds);
        dCloseODE();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench_mobile: %s\n", e.what());
        return 1;
    }
    return 0;
}
