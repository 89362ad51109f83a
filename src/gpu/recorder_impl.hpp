// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: what a Recorder is made of.
#pragma once

#include <functional>
#include <set>

#include "gpu/descriptors.hpp"
#include "gpu/hazards.hpp"
#include "gpu/timestamps.hpp"
#include "gpu/vulkan.hpp"

namespace gnomon::gpu {

/// What is expensive to make, lent by the device to one recorder after the other.
struct RecorderState {
    explicit RecorderState(Device::Impl& device) : commands(device.take_commands()), sets(device), timestamps(device) {}

    Commands commands;
    DescriptorSets sets;
    Timestamps timestamps;
    Memory staging;  ///< kStagingBytes that the host sees, made at first use.
};

struct Download::State {
    std::string name;  // of the buffer
    std::vector<std::byte> data;
    bool ready = false;
};

struct Recorder::Impl {
    using Record = std::function<void(VkCommandBuffer)>;

    /// Commands of one stage without a barrier among them, which are measured together.
    struct Span {
        std::string stage;      // empty for copies from and to the host, which are no stage
        std::string pace_key;   // of dispatches
        uint64_t groups = 0;    // of an indirect dispatch: at most
        double expected = 0.0;  // seconds
        uint64_t dispatches = 1;
        std::shared_ptr<Download::State> arguments;  // of an indirect dispatch
        bool marked = false;
    };
    /// Bytes that the host is to get when the work is done.
    struct Fetch {
        std::shared_ptr<Buffer::Impl> buffer;
        uint64_t offset = 0;
        uint64_t bytes = 0;
        std::byte* to = nullptr;
        std::shared_ptr<Download::State> state;  // of which this is the last part
        std::optional<uint64_t> staged_at;       // else it is read from the buffer, which the host sees
    };

    explicit Impl(const std::shared_ptr<Device::Impl>& owner);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// Add one command. Errors: see flush().
    void add(Span what, std::span<const Access> accesses, const Record& record_command);
    /// Add a dispatch of the grid, in pieces where it may take long; record_piece(commands, first_row, rows) records one.
    void add_pieces(std::string_view stage, const std::string& pace_key, const Grid& grid, std::span<const Access> accesses,
                    const std::function<void(VkCommandBuffer, uint32_t, uint32_t)>& record_piece);
    void add_copy(const std::string& stage, const Access& from, VkBuffer from_handle, const Access& to, VkBuffer to_handle);
    /// Run and wait first, if this much more would be too much at one time.
    void make_time(double seconds);
    void upload(const std::shared_ptr<Buffer::Impl>& buffer, std::span<const std::byte> data, uint64_t offset);
    /// The bytes will be at `to`, and `state`, where there is one, ready, after the next flush or a later one.
    void fetch(const std::shared_ptr<Buffer::Impl>& buffer, uint64_t offset, uint64_t bytes, std::byte* to,
               const std::shared_ptr<Download::State>& state);
    std::shared_ptr<Download::State> fetch_new(const std::shared_ptr<Buffer::Impl>& buffer, uint64_t offset, uint64_t bytes);
    /// Run what is recorded and wait; what it needs stays.
    void flush();
    void reset();

    std::shared_ptr<Device::Impl> device;
    std::unique_ptr<RecorderState> state;
    std::vector<std::shared_ptr<const void>> in_use;  // until submit()
    bool marked = false;                              // see Recorder::mark

    // Since the last flush:
    bool recording = false;
    std::vector<Span> spans;
    double expected = 0.0;  // seconds, of these
    Hazards hazards;
    std::set<const void*> used;  // buffers
    std::vector<Fetch> fetches;
    uint64_t staged = 0;  // bytes of the staging memory

private:
    void begin();
    const Memory& staging();
    /// Fetches from where this command is going to write are staged.
    void stage_before(const Access& write);
    void finish_fetches();
    void account(double wall_seconds);
    void forget();
};

}  // namespace gnomon::gpu
