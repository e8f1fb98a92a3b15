// SPDX-License-Identifier: MIT
#include "host/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace plumb {
namespace {

/// "warning: " and the like; nothing before what the user asked for or must know.
class Kind final : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&,
                spdlog::memory_buf_t& to) override {
        const std::string_view word = word_of(message.level);
        to.append(word.data(), word.data() + word.size());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override {
        return std::make_unique<Kind>();
    }

private:
    static std::string_view word_of(spdlog::level::level_enum level) {
        switch (level) {
            case spdlog::level::trace:
                return "trace: ";
            case spdlog::level::debug:
                return "debug: ";
            case spdlog::level::warn:
                return "warning: ";
            default:
                return "";
        }
    }
};

std::shared_ptr<spdlog::logger> made_logger() {
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<Kind>('*').set_pattern("plumb: %*%v");
    auto made = std::make_shared<spdlog::logger>("plumb",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_formatter(std::move(formatter));
    made->set_level(spdlog::level::warn);
    return made;
}

/// Never destroyed: a message may come after the end of main.
struct Loggers {
    const std::shared_ptr<spdlog::logger> first = made_logger();
    std::shared_ptr<spdlog::logger> now = first;
};
Loggers& loggers() {
    static Loggers& all = *new Loggers;
    return all;
}

/// In place of the logger of all, while an ErrorsOnly lives.
thread_local std::shared_ptr<spdlog::logger> of_thread;

}  // namespace

std::shared_ptr<spdlog::logger> logger() { return of_thread ? of_thread : loggers().now; }

void set_logger(std::shared_ptr<spdlog::logger> logger) {
    loggers().now = logger ? std::move(logger) : loggers().first;
}

ErrorsOnly::ErrorsOnly() : before_(of_thread) {
    const std::shared_ptr<spdlog::logger> now = logger();
    if (now->level() < spdlog::level::info) return;
    of_thread = now->clone(now->name());
    of_thread->set_level(std::max(now->level(), spdlog::level::err));
}
ErrorsOnly::~ErrorsOnly() { of_thread = before_; }

}  // namespace plumb
