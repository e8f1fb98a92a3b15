// SPDX-License-Identifier: MIT
/// Plugins that must not share a process are not made one after the other in one.
#include "host/conflicts.h"
#include "scene/error.h"
#include "support/scenes.h"

namespace plumb::test {
namespace {

PluginTable table(const char* name, const char* conflicts) {
    PluginTable t{};
    t.name = name;
    t.conflicts = conflicts;
    return t;
}

TEST(Conflicts, AreThoseThatEitherTableNames) {
    static const PluginTable used = table("left", "right, farright");
    static const PluginTable quiet = table("quiet", nullptr);
    const PluginTable right = table("right", nullptr), far_right = table("farright", nullptr),
                      enemy = table("enemy", "quiet,left"), friendly = table("rig", "lef"),
                      empty = table("empty", "");
    EXPECT_EQ(conflict_of(right), "") << "nothing has been used yet";
    note_use(used);
    note_use(quiet);
    EXPECT_EQ(conflict_of(used), "") << "a plugin may be used again";
    EXPECT_EQ(conflict_of(right), "left");
    EXPECT_EQ(conflict_of(far_right), "left");
    EXPECT_EQ(conflict_of(friendly), "") << "a part of a name is no name";
    EXPECT_EQ(conflict_of(empty), "");
    EXPECT_FALSE(conflict_of(enemy).empty());
}

TEST(Conflicts, AreRefusedByTheLibraryBeforeAnythingIsMade) {
    static const PluginTable used = table("loner", "notanumber");
    note_use(used);
    const ColliderLibrary library(PLUMB_TEST_BAD_PLUGINS);
    try {
        library.create(library.find("notanumber"), 1);
        FAIL() << "it was made";
    } catch (const ColliderError& e) {
        EXPECT_STREQ(e.what(),
                     "collider \"notanumber\" must not share a process with \"loner\", which this "
                     "one has used; run it in a process of its own");
    }
}

}  // namespace
}  // namespace plumb::test
