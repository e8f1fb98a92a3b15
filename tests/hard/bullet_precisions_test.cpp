// SPDX-License-Identifier: MIT
/// Bullet float with Bullet double: whichever comes second to a process is refused with a sentence,
/// by the host and by the plugin itself, and the first one answers as before.
#include "scene/error.h"
#include "support/scenes.h"

#include <cstdio>
#include <cstdlib>

namespace plumb::test {
namespace {

constexpr int kRefused = 3;  ///< exit code: refused, and the first one is sound

/// Each case gets a new process, where neither was used.
class BulletFloatWithBulletDouble : public testing::Test {
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

std::uint64_t hash_of_fall(const char* collider) {
    Scene scene;
    add_ground(scene);
    for (int i = 0; i < 6; ++i)
        add_body(scene, i % 2 ? box(.3, .2, .25) : sphere(.3), {.1 * i, .4 + .5 * i, .05 * i});
    Simulation simulation(scene, colliders(), collider);
    for (int i = 0; i < 60; ++i) simulation.step();
    return state_hash(simulation.world());
}

/// What the library of colliders says.
std::string said_by_host(const char* second) {
    try {
        colliders().create(colliders().find(second), 1);
    } catch (const ColliderError& e) {
        return e.what();
    }
    return {};
}

/// What the plugin says where nobody has looked at its table's conflicts.
std::string said_by_plugin(const char* second) {
    const CreateRequest request{1, 0, nullptr};
    const char* message = nullptr;
    const PluginTable& table = *colliders().find(second).table;
    if (table.create(&request, &message) || !message) return {};
    return message;
}

[[noreturn]] void use(const char* first, std::string (*ask)(const char*), const char* second) {
    const std::uint64_t before = hash_of_fall(first);
    const std::string said = ask(second);
    std::fprintf(stderr, "%s\n", said.c_str());
    std::_Exit(!said.empty() && hash_of_fall(first) == before ? kRefused : 1);
}

const testing::ExitedWithCode kIsRefused(kRefused);

TEST_F(BulletFloatWithBulletDouble, IsRefusedByTheHost) {
    EXPECT_EXIT(use("bullet", said_by_host, "bullet_float"), kIsRefused,
                "\"bullet_float\" must not share a process with \"bullet\"");
    EXPECT_EXIT(use("bullet_float", said_by_host, "bullet"), kIsRefused,
                "\"bullet\" must not share a process with \"bullet_float\"");
}

TEST_F(BulletFloatWithBulletDouble, IsRefusedByThePluginItself) {
    EXPECT_EXIT(use("bullet", said_by_plugin, "bullet_float"), kIsRefused,
                "bullet_float cannot be used in a process that has loaded Bullet in double");
    EXPECT_EXIT(use("bullet_float", said_by_plugin, "bullet"), kIsRefused,
                "bullet cannot be used in a process that has loaded Bullet in single");
}

TEST_F(BulletFloatWithBulletDouble, AreBothListedWhicheverIsUsed) {
    for (const char* name : {"bullet", "bullet_float"}) {
        const PluginTable* table = colliders().find(name).table;
        ASSERT_NE(table, nullptr);
        EXPECT_STREQ(table->precision, name == std::string("bullet") ? "double" : "single");
    }
}

}  // namespace
}  // namespace plumb::test
