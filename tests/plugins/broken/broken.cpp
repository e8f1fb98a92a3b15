// SPDX-License-Identifier: MIT
/// A sound plugin with one fault put in: PLUMB_FAULT names it, and the plugin.
#include <plumb/plugin.h>

#include <dlfcn.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <vector>

#define PLUMB_TEXT_OF(x) #x
#define PLUMB_TEXT(x) PLUMB_TEXT_OF(x)

namespace {

using namespace plumb;

enum class Fault { none, flipped, dropping, unstable, unsorted, longer, throwing, hanging };
constexpr Fault kFault = Fault::PLUMB_FAULT;

const PluginTable& sound() {
    static const PluginTable* const table = [] {
        void* library = dlopen(PLUMB_SOUND_PLUGIN, RTLD_NOW | RTLD_LOCAL);
        return reinterpret_cast<PluginEntry>(dlsym(library, kPluginSymbol))();
    }();
    return *table;
}

/// Contacts of the sound collider, on their way through.
struct Catch {
    std::vector<std::vector<Contact>> blocks;
    static Contact* grow(void* ctx, std::uint32_t count) {
        return static_cast<Catch*>(ctx)->blocks.emplace_back(count).data();
    }
};

class Broken : public Proximity {
public:
    explicit Broken(const CreateRequest* request) : sound_(sound().create(request, nullptr)) {
        if (!sound_) throw std::runtime_error("the sound plugin makes no collider");
    }
    virtual ~Broken() { sound().destroy(sound_); }

    Status add(std::uint32_t body, const ShapePlacement& placement) noexcept override {
        return sound_->add(body, placement);
    }
    Status remove(std::uint32_t body) noexcept override { return sound_->remove(body); }
    Status exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept override {
        return sound_->exclude(a, b, excluded);
    }
    DetectStats stats() const noexcept override { return sound_->stats(); }

    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t sink_count) noexcept override {
        if (kFault == Fault::none) return sound_->detect(request, sinks, sink_count);
        if (kFault == Fault::hanging && (request.flags & kDetectRaw))
            for (volatile bool forever = true; forever;) {
            }
        if (kFault == Fault::throwing) fail();
        if (!sinks || !sink_count) return sound_->detect(request, sinks, sink_count);
        Catch caught;
        const ContactSink sink{&caught, Catch::grow};
        const Status status = sound_->detect(request, &sink, 1);
        std::vector<Contact> all;
        for (const auto& block : caught.blocks) all.insert(all.end(), block.begin(), block.end());
        spoil(all);
        if (all.empty()) return status;
        Contact* room = sinks[0].grow(sinks[0].ctx, static_cast<std::uint32_t>(all.size()));
        if (!room) return {Status::out_of_memory, 0, "the sink takes no more"};
        std::copy(all.begin(), all.end(), room);
        return status;
    }

private:
    [[gnu::noinline]] static void fail() {
        throw std::runtime_error("the fault that was asked for");
    }

    void spoil(std::vector<Contact>& contacts) {
        ++calls_;
        for (Contact& c : contacts) {
            if (kFault == Fault::flipped) {
                c.normal = {-c.normal.x, -c.normal.y, -c.normal.z};
            }
            if (kFault == Fault::unstable) c.feature = c.feature / 2 + calls_;
            if (kFault == Fault::longer) c.gap += 1e-3;
        }
        if (kFault == Fault::unsorted) std::reverse(contacts.begin(), contacts.end());
        if (kFault == Fault::dropping)
            std::erase_if(contacts, [](const Contact& c) { return c.gap > -1e-3; });
    }

    Proximity* sound_;
    std::uint64_t calls_ = 0;
};

Proximity* create(const CreateRequest* request, const char** message) {
    try {
        return new Broken(request);
    } catch (...) {
        if (message) *message = "the sound plugin makes no collider";
        return nullptr;
    }
}
void destroy(Proximity* proximity) { delete static_cast<Broken*>(proximity); }

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const PluginTable table = [] {
        PluginTable t = sound();
        t.name = PLUMB_TEXT(PLUMB_FAULT);
        t.create = create;
        t.destroy = destroy;
        return t;
    }();
    return &table;
}
