// SPDX-License-Identifier: MIT
/// Workers, threads and worlds side by side: the same contacts, bit for bit.
#include "population.h"
#include "standing.h"

#include <atomic>
#include <thread>

namespace plumb::test {
namespace {

/// Runs each task on a thread of its own.
void run_on_threads(void* ctx, void (*task)(void*, std::uint32_t), void* arg) {
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < *static_cast<std::uint32_t*>(ctx); ++i)
        threads.emplace_back(task, arg, i);
    for (std::thread& t : threads) t.join();
}

class Threads : public EachPlugin {
protected:
    /// A heap of solids over a floor, and of meshes where the plugin takes them.
    void fill(World& world, unsigned seed) const {
        throw_heap(world, GetParam(), seed, 90);
        std::uint32_t id = 100;
        for (const Stack& stack : stacks(GetParam())) {
            if (!(stack.ability & kPairThreadSafe)) continue;
            const Place frame{V(3.0 * (id % 8), -20, 3.0 * (id / 8)), Q::Identity()};
            Place at = stack.upper.place;
            at.x.y() -= 0.002;
            if (stack.lower.shape.kind == ShapeKind::plane) continue;
            world.add(id, stack.lower.shape, frame * stack.lower.place, Mobility::fixed);
            world.add(id + 1, stack.upper.shape, frame * at);
            id += 2;
        }
    }
};

TEST_P(Threads, WorkersFindTheSameContacts) {
    World alone(GetParam());
    fill(alone, 1);
    const std::vector<Contact> expected = alone.detect(kMargin);
    for (std::uint32_t workers : {1u, 2u, 4u})
        for (std::uint32_t sinks : {1u, workers, workers + 1}) {
            World world(GetParam(), workers);
            fill(world, 1);
            TaskRunner runner{&workers, workers, run_on_threads};
            world.runner = &runner;
            world.sinks = sinks;
            for (int again = 0; again < 3; ++again)
                EXPECT_TRUE(same(world.detect(kMargin), expected))
                    << workers << " workers, " << sinks << " sinks";
        }
}

TEST_P(Threads, TwoWorldsDoNotKnowOfEachOther) {
    World one(GetParam()), two(GetParam());
    fill(one, 1);
    fill(two, 2);
    const std::vector<Contact> first = one.detect(kMargin), second = two.detect(kMargin);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(same(one.detect(kMargin), first));
        EXPECT_TRUE(same(two.detect(kMargin), second));
    }
}

TEST_P(Threads, TwoWorldsAtOnceAreTwoWorlds) {
    std::atomic<int> wrong{0};
    const auto work = [&](unsigned seed) {
        World calm(GetParam());
        fill(calm, seed);
        const std::vector<Contact> expected = calm.detect(kMargin);
        for (int i = 0; i < 10; ++i) {
            World world(GetParam());
            fill(world, seed);
            wrong += !same(world.detect(kMargin), expected);
        }
    };
    std::thread other(work, 1);
    work(2);
    other.join();
    EXPECT_EQ(wrong, 0) << "answers that differ when two threads ask at once";
    // And what they agreed on is what one thread alone finds.
    World first(GetParam()), second(GetParam());
    fill(first, 1);
    fill(second, 1);
    EXPECT_TRUE(same(first.detect(kMargin), second.detect(kMargin)));
}

PLUMB_FOR_EACH_PLUGIN(Threads);

}  // namespace
}  // namespace plumb::test
