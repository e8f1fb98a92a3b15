// SPDX-License-Identifier: MIT
/// Worker threads that run one function together, in fixed shares.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <type_traits>
#include <vector>

namespace plumb {

/// Half-open range of items.
struct Range {
    std::uint32_t first, last;
};

/// A team of n workers, of which the caller is the first. Shares depend on n and the item count
/// alone, and the solver gives the same bits for any n because items of one share never touch those
/// of another.
class Workers {
public:
    explicit Workers(std::uint32_t count);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    std::uint32_t count() const { return count_; }

    /// Calls task(worker) once on every worker and returns when all have returned. Allocates
    /// nothing.
    template <class Task>
    void run(Task&& task) {
        run_all(
            [](void* context, std::uint32_t worker) {
                (*static_cast<std::remove_reference_t<Task>*>(context))(worker);
            },
            &task);
    }

    /// While it lives, idle workers look for tasks and do not sleep: to wake one takes longer than
    /// most tasks of a step.
    class Awake {
    public:
        explicit Awake(Workers& workers) : workers_(workers) { workers_.awake_ = true; }
        ~Awake() { workers_.awake_ = false; }
        Awake(const Awake&) = delete;
        Awake& operator=(const Awake&) = delete;

    private:
        Workers& workers_;
    };

    /// Calls task(range, worker) for the shares of `items`; few are not worth waking anybody for.
    template <class Task>
    void share_out(std::size_t items, Task&& task) {
        const auto n = static_cast<std::uint32_t>(items);
        if (count_ == 1 || n < kFew) return task(Range{0, n}, 0u);
        run([&](std::uint32_t worker) { task(share(n, worker), worker); });
    }

    /// Calls visit(item, worker) for `items` of them, which do not depend on each other.
    template <class Visit>
    void each(std::size_t items, Visit visit) {
        share_out(
            items, [&](Range of, std::uint32_t worker) __attribute__((flatten)) {
                for (std::uint32_t i = of.first; i < of.last; ++i) visit(i, worker);
            });
    }

    /// Inside of a task: waits until every worker has come here.
    void barrier();

    /// Share of `items` that a worker takes.
    Range share(std::uint32_t items, std::uint32_t worker) const {
        return {static_cast<std::uint32_t>(std::uint64_t(items) * worker / count_),
                static_cast<std::uint32_t>(std::uint64_t(items) * (worker + 1) / count_)};
    }

    static constexpr std::uint32_t kFew = 128;  ///< items that take about as long as to call one

private:
    using Call = void (*)(void* context, std::uint32_t worker);
    void run_all(Call call, void* context);
    void wait_for_tasks(std::uint32_t worker);

    std::uint32_t count_;
    Call call_ = nullptr;
    void* context_ = nullptr;
    std::atomic<std::uint64_t> round_{0};
    std::atomic<std::uint32_t> running_{0};
    std::atomic<bool> awake_{false};
    std::atomic<bool> stop_{false};
    std::atomic<std::uint32_t> arrived_{0};
    std::atomic<std::uint64_t> barriers_{0};
    std::vector<std::thread> threads_;
};

}  // namespace plumb
