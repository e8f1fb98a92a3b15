// SPDX-License-Identifier: MIT
/// What accuracy costs in a program's own scene: a ball that swings on two rods is swept over the
/// settings, and the sentences that follow are printed.
#include "scene/build.h"
#include "study/findings.h"
#include "study/self_reference.h"
#include "study/sweep.h"

#include <cstdio>
#include <exception>

namespace {

plumb::Scene swing() {
    plumb::Scene scene;
    scene.settings.duration = 2;
    scene.settings.forbid = {"contacts"};
    plumb::add_body(scene, plumb::box(0.5, 0.02, 0.02), {0.5, 0, 0}).mass = 1;
    plumb::add_body(scene, plumb::sphere(0.1), {1, 0, 0}).mass = 2;
    plumb::add_joint(scene, plumb::JointKind::ball, 0, plumb::kNoIndex, {0, 0, 0});
    plumb::add_joint(scene, plumb::JointKind::ball, 1, 0, {1, 0, 0});
    return scene;
}

}  // namespace

int main() try {
    const plumb::ColliderLibrary colliders(PLUGIN_DIRECTORY);
    const plumb::study::ReferenceOptions references{.seconds = 2};
    const std::vector<plumb::study::Subject> subjects{
        plumb::study::self_referenced(swing(), "swing", colliders, references)};

    plumb::study::SweepChoice choice;
    choice.curves = {"pbd", "leapfrog start"};
    plumb::study::StudyTable table = plumb::study::plan_sweep(subjects, choice, colliders);
    plumb::study::sweep(table, subjects, colliders, {.budget = 10, .repeats = 1});

    for (const std::string& sentence : plumb::study::advice_on(table, table.subjects[0]))
        std::puts(sentence.c_str());
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
