// SPDX-License-Identifier: MIT
/// What the conformance suite stands on: a small world of bodies on a plugin's collider, and what
/// holds for every contact set.
#pragma once

#include "loading.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace plumb::test {

inline constexpr double kMargin = 0.01;  ///< of detection, where a test does not need another [m]

/// Bodies of one collider, and the last answer.
class World {
public:
    explicit World(const std::string& name, std::uint32_t threads = 1);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    Status add(std::uint32_t id, const Shape& shape, const Place& place,
               Mobility mobility = Mobility::dynamic, std::uint32_t group = 1,
               std::uint32_t mask = ~0u, const Place& local = {});
    void move(std::uint32_t id, const Place& place);
    void move_raw(std::uint32_t id, const Pose& raw);
    const std::vector<Contact>& detect(double margin, std::uint32_t flags = 0);
    const std::vector<Contact>& last() const { return contacts_; }
    Status status() const { return status_; }
    Proximity& collider() { return *collider_; }

    std::vector<double> sweeps;          ///< [body] or empty [m]
    const PairFilter* filter = nullptr;  ///< of the next `detect`
    const TaskRunner* runner = nullptr;  ///< of the next `detect`
    std::uint32_t sinks = 1;             ///< handed to `detect`

private:
    const PluginTable& table_;
    Proximity* collider_;
    std::vector<Pose> poses_;
    std::vector<Contact> contacts_;
    Status status_{};
};

/// The deepest of some contacts.
const Contact& deepest(const std::vector<Contact>& contacts);

/// Least gap of each pair of bodies [m].
using Gaps = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;
Gaps deepest_of_pairs(const std::vector<Contact>& contacts);

/// Whether two answers are the same bits.
bool same(const std::vector<Contact>& p, const std::vector<Contact>& q);

/// Area spanned by the contacts' points on a, seen along the normal of the first [m²].
double spanned_area(const std::vector<Contact>& contacts);

/// Whether a contact set says which features touch; a back-end's own need not.
enum class Features { known, some };

/// Checks what holds for every contact set: signs, units, order, unique features.
void expect_sound(const std::vector<Contact>& contacts, double margin,
                  Features features = Features::known);

class EachPlugin : public ::testing::TestWithParam<std::string> {
protected:
    /// Skips where a plugin was tested before that must not share a process with this one.
    void SetUp() override;

    /// Whether the plugin claims any of these abilities for a pair.
    bool claims(ShapeKind a, ShapeKind b, std::uint32_t wanted = ~0u) const {
        return (ability(GetParam(), a, b) & wanted) != 0;
    }
    bool claims(const Shape& a, const Shape& b, std::uint32_t wanted = ~0u) const {
        return claims(a.kind, b.kind, wanted);
    }
};

/// A plugin's name, or a file, as part of a test's name.
std::string printable(const std::string& name_or_file);

}  // namespace plumb::test

#define PLUMB_FOR_EACH_PLUGIN(Suite)                                    \
    GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Suite);               \
    INSTANTIATE_TEST_SUITE_P(                                           \
        All, Suite, ::testing::ValuesIn(::plumb::test::plugin_names()), \
        [](const auto& param_info) { return ::plumb::test::printable(param_info.param); })

/// For tests of what a plugin need not claim.
#define PLUMB_NEEDS_CLAIM(...) \
    if (!claims(__VA_ARGS__)) GTEST_SKIP() << "the plugin does not claim this"
