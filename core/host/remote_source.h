// SPDX-License-Identifier: MIT
/// A collider in a process of its own: poses go down a socket, contacts come back.
///
/// For plugins that must not share a process with another (PluginTable::conflicts), and for those
/// that are not trusted: the child may crash or hang, and is then reported, never fatal. Both ends
/// are the same program, so that values cross as they stand in memory.
#pragma once

#include "host/contact_source.h"

#include <string>
#include <vector>

#include <sys/types.h>

namespace plumb {

/// One end of the socket between two processes; closes it in the end.
class Channel {
public:
    explicit Channel(int descriptor) : descriptor_(descriptor) {}
    ~Channel();
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;

    /// False when the other end is gone, or (receiving) silent for longer than the patience.
    bool send(const void* bytes, std::size_t count);
    bool receive(void* bytes, std::size_t count);
    bool was_silent() const { return was_silent_; }  ///< the patience is over

    void set_patience(int seconds);
    void close();

private:
    int descriptor_;
    bool was_silent_ = false;
};

class RemoteSource final : public ContactSource {
public:
    static constexpr int kDescriptor = 3;  ///< the child's end of the socket
    static constexpr int kPatience = 120;  ///< [s] that a question may take

    /// Starts `command` (its first word is the program's file), which calls serve(). Throws
    /// ColliderError with the child's own sentence when its collider cannot do the scene.
    RemoteSource(std::string name, const std::vector<std::string>& command);
    ~RemoteSource() override;

    const SourceInfo& info() const override { return info_; }
    ContactAnswer ask(const ContactQuestion& question) override;

private:
    void greet();
    [[noreturn]] void give_up();

    SourceInfo info_;
    pid_t child_ = -1;
    Channel channel_;
};

/// The child's side: answers on `descriptor` until the other end closes it. `make` makes the
/// source; what it throws is sent to the parent.
void serve(int descriptor, ContactSource* (*make)(void* ctx), void* ctx);

}  // namespace plumb
