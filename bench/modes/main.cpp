// SPDX-License-Identifier: MIT
/// By what factor a small disturbance of structures at rest grows in a step: swept, to the paper's
/// letter, and with islands solved exactly; as CSV.
#include "support/growth.h"

#include <cstdio>
#include <map>

int main(int argc, char** argv) {
    using namespace plumb;
    using namespace plumb::test;
    const ColliderLibrary colliders(argc > 1 ? argv[1] : "");
    const std::map<std::string, Structure> structures{{"2 cubes", tower(2, {0.5, 0.5, 0.5})},
                                                      {"3 cubes", tower(3, {0.5, 0.5, 0.5})},
                                                      {"6 cubes", tower(6, {0.5, 0.5, 0.5})},
                                                      {"table", table()}};
    std::printf("structure,method,h [ms],substeps,iterations,growth\n");
    for (const auto& [name, structure] : structures)
        for (const char* method : {"exact", "swept", "paper"})
            for (double dt : {0.002, 0.01})
                for (std::uint32_t substeps : {1u, 4u})
                    for (std::uint32_t iterations : {1u, 2u, 5u, 10u, 20u, 50u}) {
                        Settings s;
                        s.dt = dt, s.substeps = substeps;
                        s.velocity_iterations = s.position_iterations = iterations;
                        s.precision = Precision::double_;
                        if (std::string(method) != "exact") s.exact_islands = 0;
                        if (std::string(method) == "paper") apply_paper_preset(s);
                        std::printf("%s,%s,%g,%u,%u,%.6f\n", name.c_str(), method, dt * 1e3,
                                    substeps, iterations,
                                    growth(structure, s, colliders, "ode", 20,
                                           static_cast<int>(100 / substeps)));
                        std::fflush(stdout);
                    }
}
