// SPDX-License-Identifier: MIT
#include "host/remote_source.h"

#include "scene/error.h"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <memory>

extern char** environ;

namespace plumb {
namespace {

struct QuestionHead {
    std::uint64_t bodies;
    double margin;
    std::uint64_t raw, has_sweeps;
};
struct AnswerHead {
    std::uint64_t contacts, rejected;
    DetectStats stats;
    double seconds;
};

bool send_text(Channel& channel, const std::string& text) {
    const std::uint64_t size = text.size();
    return channel.send(&size, sizeof size) && channel.send(text.data(), text.size());
}

bool receive_text(Channel& channel, std::string& text) {
    std::uint64_t size = 0;
    if (!channel.receive(&size, sizeof size) || size > (1u << 20)) return false;
    text.resize(size);
    return channel.receive(text.data(), size);
}

/// How a process ended, in words.
std::string ending_of(pid_t child) {
    int status = 0;
    if (waitpid(child, &status, 0) != child) return "its process is gone";
    if (WIFSIGNALED(status))
        return std::string("its process was ended by a signal: ") + strsignal(WTERMSIG(status));
    return "its process ended with code " + std::to_string(WEXITSTATUS(status));
}

int start(const std::vector<std::string>& command, pid_t& child, const std::string& name) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw ColliderError("collider \"" + name +
                            "\": no socket for its process: " + std::strerror(errno));
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // A descriptor copied upon itself would stay closed on exec, so it takes a way round.
    posix_spawn_file_actions_adddup2(&actions, ends[1], RemoteSource::kDescriptor + 1);
    posix_spawn_file_actions_adddup2(&actions, RemoteSource::kDescriptor + 1,
                                     RemoteSource::kDescriptor);
    posix_spawn_file_actions_addclose(&actions, RemoteSource::kDescriptor + 1);
    const int error = posix_spawn(&child, words[0], &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (error == 0) return ends[0];
    ::close(ends[0]);
    throw ColliderError("collider \"" + name +
                        "\": its process could not be started: " + std::strerror(error));
}

/// What a question brings, its memory used again for the next.
struct QuestionData {
    std::vector<Pose> poses;
    std::vector<double> sweeps;
};

bool answer_one(Channel& channel, ContactSource& source, QuestionData& data) {
    QuestionHead head{};
    if (!channel.receive(&head, sizeof head)) return false;
    data.poses.resize(head.bodies);
    data.sweeps.resize(head.has_sweeps ? head.bodies : 0);
    if (!channel.receive(data.poses.data(), data.poses.size() * sizeof(Pose)) ||
        !channel.receive(data.sweeps.data(), data.sweeps.size() * sizeof(double)))
        return false;
    const double* sweeps = head.has_sweeps ? data.sweeps.data() : nullptr;
    const ContactAnswer answer = source.ask({data.poses, head.margin, head.raw != 0, sweeps});
    const AnswerHead reply{answer.contacts.size(), answer.rejected, answer.stats, answer.seconds};
    return channel.send(&reply, sizeof reply) &&
           channel.send(answer.contacts.data(), answer.contacts.size() * sizeof(Contact)) &&
           send_text(channel, answer.trouble);
}

}  // namespace

Channel::~Channel() { close(); }

void Channel::close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
}

void Channel::set_patience(int seconds) {
    const timeval wait{seconds, 0};
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
}

bool Channel::send(const void* bytes, std::size_t count) {
    const char* from = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t sent = ::send(descriptor_, from, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        from += sent, count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool Channel::receive(void* bytes, std::size_t count) {
    char* to = static_cast<char*>(bytes);
    while (count > 0) {
        const ssize_t got = ::recv(descriptor_, to, count, 0);
        if (got < 0 && errno == EINTR) continue;
        was_silent_ = got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
        if (got <= 0) return false;
        to += got, count -= static_cast<std::size_t>(got);
    }
    return true;
}

RemoteSource::RemoteSource(std::string name, const std::vector<std::string>& command)
    : info_{std::move(name), "", ""}, channel_(start(command, child_, info_.name)) {
    channel_.set_patience(kPatience);
    greet();
}

RemoteSource::~RemoteSource() {
    channel_.close();  // ends the child, which is waiting for a question
    if (child_ > 0) ending_of(child_);
}

void RemoteSource::greet() {
    std::string refusal;
    if (!receive_text(channel_, refusal)) give_up();
    if (!refusal.empty()) {
        channel_.close();
        ending_of(child_);
        child_ = -1;
        throw ColliderError(refusal);
    }
    if (!receive_text(channel_, info_.version) || !receive_text(channel_, info_.precision))
        give_up();
}

ContactAnswer RemoteSource::ask(const ContactQuestion& question) {
    if (child_ < 0) throw ColliderError("collider \"" + info_.name + "\": its process is gone");
    const QuestionHead head{question.poses.size(), question.margin, question.raw ? 1u : 0u,
                            question.sweeps ? 1u : 0u};
    AnswerHead reply{};
    ContactAnswer answer;
    const bool asked = channel_.send(&head, sizeof head) &&
                       channel_.send(question.poses.data(), question.poses.size() * sizeof(Pose)) &&
                       (!question.sweeps ||
                        channel_.send(question.sweeps, question.poses.size() * sizeof(double)));
    if (!asked || !channel_.receive(&reply, sizeof reply)) give_up();
    answer.contacts.resize(reply.contacts);
    if (!channel_.receive(answer.contacts.data(), answer.contacts.size() * sizeof(Contact)) ||
        !receive_text(channel_, answer.trouble))
        give_up();
    answer.rejected = static_cast<std::uint32_t>(reply.rejected);
    answer.stats = reply.stats;
    answer.seconds = reply.seconds;
    return answer;
}

void RemoteSource::give_up() {
    const bool silent = channel_.was_silent();
    if (silent) kill(child_, SIGKILL);
    channel_.close();
    const std::string ending = ending_of(child_);
    child_ = -1;
    throw ColliderError(
        "collider \"" + info_.name + "\" gave no answer: " +
        (silent ? "it took longer than " + std::to_string(kPatience) + " s" : ending));
}

void serve(int descriptor, ContactSource* (*make)(void* ctx), void* ctx) {
    Channel channel(descriptor);
    std::unique_ptr<ContactSource> source;
    try {
        source.reset(make(ctx));
    } catch (const std::exception& e) {
        send_text(channel, e.what());
        return;
    }
    if (!send_text(channel, "") || !send_text(channel, source->info().version) ||
        !send_text(channel, source->info().precision))
        return;
    QuestionData data;
    while (answer_one(channel, *source, data)) {
    }
}

}  // namespace plumb
