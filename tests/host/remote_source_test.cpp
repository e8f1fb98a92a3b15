// SPDX-License-Identifier: MIT
/// What is said of a collider's process that does not answer as it should.
#include "host/remote_source.h"
#include "scene/error.h"

#include <gtest/gtest.h>

#include <cerrno>

namespace plumb {
namespace {

/// The sentence about a process that runs these words of a shell in place of a collider.
std::string sentence_about(const std::string& words) {
    try {
        const RemoteSource source("odd", {"/bin/sh", "-c", words});
    } catch (const ColliderError& error) {
        return error.what();
    }
    return "none";
}

TEST(RemoteSource, TellsHowAProcessEndedThatSaidNothing) {
    EXPECT_EQ(sentence_about("exit 7"),
              "collider \"odd\" gave no answer: its process ended with code 7");
    EXPECT_EQ(sentence_about("kill -ABRT $$"),
              "collider \"odd\" gave no answer: its process was ended by a signal: Aborted");
}

/// An error that was left behind by some other call is not taken for the process's silence.
TEST(RemoteSource, TellsNoSilenceWhereNonsenseWasSaid) {
    errno = EAGAIN;
    EXPECT_EQ(sentence_about("printf '\\377\\377\\377\\377\\377\\377\\377\\377' >&3; exit 7"),
              "collider \"odd\" gave no answer: its process ended with code 7");
}

TEST(RemoteSource, TellsWhatTheProcessItselfSays) {
    EXPECT_EQ(sentence_about("printf '\\003\\000\\000\\000\\000\\000\\000\\000why' >&3"), "why");
}

}  // namespace
}  // namespace plumb
