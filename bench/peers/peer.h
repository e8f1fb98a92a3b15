// SPDX-License-Identifier: MIT
/// What the peers share: a scene from Plumb's reader, thread CPU time, and the line that they
/// print.
#pragma once

#include "reader/reader.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace plumb::peer {

/// CPU time of this thread [ms]: another program on the same processor does not count.
inline double now_ms() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

inline double median(std::vector<double> v) {
    if (v.empty()) return 0;
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

/// Times of the second half of a run [ms].
struct Times {
    std::vector<double> detect, solve, step, points;
    void print(const char* engine, const Scene& scene, int iterations) const {
        std::printf(
            "%s %s, %d iterations: step %.3f ms, detect %.3f ms, solve %.3f ms, %.0f contact "
            "points\n",
            engine, scene.name.c_str(), iterations, median(step), median(detect), median(solve),
            median(points));
    }
};

constexpr int kSteps = 1000, kMeasuredFrom = 500;

struct Arguments {
    Scene scene;
    int iterations;
};
inline Arguments arguments(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s SCENE.json ITERATIONS\n", argv[0]);
        std::exit(2);
    }
    return {read_scene(argv[1]), std::atoi(argv[2])};
}

inline double density_of(const Scene& scene, const BodySpec& body) {
    return scene.materials[body.material].density;
}

}  // namespace plumb::peer
