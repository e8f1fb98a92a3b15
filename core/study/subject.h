// SPDX-License-Identifier: MIT
/// What a study measures: a scene, and how far a run of it is from what is right.
///
/// A subject comes from the library of cases with known answers (cases.h), or from any scene at
/// all, which is then measured against finer runs of itself (self_reference.h).
#pragma once

#include "scene/scene.h"
#include "world/world.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumb::study {

/// Follows one run and tells how far it was off.
class Judge {
public:
    virtual ~Judge() = default;

    /// Looks at the world before the first step and after each one.
    virtual void look(const World& world) = 0;

    /// Error of all that was looked at, in the unit of the metric; at least 0.
    virtual double error() const = 0;
};

/// One way of measuring the error of a run.
struct Metric {
    std::string name;  ///< one word, as on a command line
    std::string unit;  ///< "" where it is a ratio
    std::string what;  ///< what it is, in a few words: "largest error of the angle"
    std::function<std::unique_ptr<Judge>()> judge;  ///< makes a judge for a run that begins
    double reference_error = 0;                     ///< of what runs are compared with; 0: exact
};

/// Order of convergence that theory gives, for one way of refining; 0 where it gives none.
struct Orders {
    double substeps = 0;    ///< error ~ substeps^−order, at one iteration each
    double iterations = 0;  ///< error ~ iterations^−order, of one substep
    double step = 0;        ///< error ~ dt^order
};

struct Subject {
    std::string name;             ///< as on the command line
    std::string title;            ///< one sentence: what moves, and what is known of it
    std::string reference;        ///< where the right answer comes from, in a few words
    Scene scene;                  ///< settings: those to begin from; duration: simulated time
    std::vector<Metric> metrics;  ///< the first is the subject's own
    double tolerance = 0;  ///< error that the scene's own settings keep within; 0: not stated
    Orders orders;         ///< of the first metric
    double horizon = 0;    ///< until when poses can be predicted and are compared [s]; 0: all along
    std::uint32_t reference_substeps =
        0;                    ///< of a reference that is a run, to a step; 0: a formula
    std::string fingerprint;  ///< of the file that the scene came from; "" of a case
};

}  // namespace plumb::study
