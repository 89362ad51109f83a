// SPDX-License-Identifier: Apache-2.0
// Vulkan 1.3 compute behind a few types: device, buffers, programs, a recorder. The only header through which the rest of
// gnomon sees the GPU; Vulkan itself is included in src/gpu/*.cpp only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <gnomon/render.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::gpu {

/// How a shader sees a buffer through a (uniform) texel buffer: samplerBuffer or usamplerBuffer.
enum class Texel {
    r32_float,
    rg32_float,
    rgba32_float,
    r32_uint,
    rg32_uint,
    rgba32_uint,
    r16_uint,
    rg16_uint,
    rgba16_uint,
    r8_uint,
    rg8_uint,
    rgba8_uint,
};

/// Devices that have fewer texels in a buffer view read through storage buffers.
constexpr uint64_t kManyTexels = uint64_t{1} << 24;

struct Limits {
    uint64_t heap_bytes = 0;         ///< Of the largest device-local heap.
    uint64_t max_buffer_bytes = 0;   ///< One allocation.
    uint64_t max_storage_range = 0;  ///< Bytes of one storage-buffer binding (128 MiB on lavapipe).
    uint64_t storage_alignment = 1;  ///< Of a storage binding's offset.
    uint64_t max_texels = 0;         ///< Elements of one texel-buffer binding.
    bool texel_reads = true;         ///< Stages read through texel buffers where they can.
    uint64_t texel_alignment = 1;    ///< Of a texel binding's offset.
    bool storage_8bit = false;       ///< Storage buffers may have elements of 8 bits,
    bool storage_16bit = false;      ///< and of 16.
    uint32_t max_groups = 65535;     ///< Along one axis of a dispatch.
    uint32_t subgroup_size = 1;      ///< Of all pipelines; a device that cannot be asked for one size may use others.
    uint32_t crew = 8;               ///< Most invocations that share what they fetch by shuffles: 1, 2, 4 or 8.
    bool shuffles = true;            ///< Devices without them are not used.
    uint32_t storage_buffers = 4;    ///< Of one shader.
    uint32_t push_constant_bytes = 128;
    uint32_t dispatch_ms = 50;  ///< Milliseconds; what is expected to take longer is cut into pieces. Ten times less than is
                                ///< allowed, since the next piece may hold more work.
    bool timestamps = false;    ///< Else stages have no seconds.
    bool mapped = false;        ///< The host sees buffers; else uploads and downloads are staged.
    bool is_cpu = false;
    uint32_t threads = 1;  ///< Each of which takes one contiguous part of a dispatch; 1 where workgroups start in order.

    /// Stages read through storage buffers: some devices have texel buffers of as few as 65,536 elements.
    bool storage_reads() const { return !texel_reads || max_texels < kManyTexels; }
    /// Elements of so many bytes that a stage can read through one binding.
    uint64_t most_elements(uint64_t bytes) const { return storage_reads() ? max_storage_range / bytes : max_texels; }
};

class Device;

/// Device memory with a name, of a pool that the device keeps. Move-only; given back when it goes, or, if recorded work still
/// needs it, when that work is done. May outlive its Device object. An empty Buffer has no device.
class Buffer {
public:
    Buffer();
    ~Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;
    uint64_t bytes() const;  ///< As asked for; of the smallest buffer, 16.
    explicit operator bool() const;

    struct Impl;
    const std::shared_ptr<Impl>& impl() const { return impl_; }

private:
    friend class Device;
    std::shared_ptr<Impl> impl_;
};

/// SPIR-V and the name of its stage ("sample/trace").
struct Shader {
    std::string name;
    std::span<const uint32_t> spirv;
};

/// A compute pipeline with what its SPIR-V declares: bindings by name, bytes of push constants, specialization constants.
class Program {
public:
    Program();
    ~Program();
    Program(Program&&) noexcept;
    Program& operator=(Program&&) noexcept;
    explicit operator bool() const { return impl_ != nullptr; }

    struct Impl;
    const std::shared_ptr<Impl>& impl() const { return impl_; }

private:
    friend class Device;
    std::shared_ptr<Impl> impl_;
};

/// One buffer for one resource of a shader, by the resource's GLSL name (the block's name for storage and uniform buffers, the
/// variable's name for texel buffers). `texel` is used for texel buffers only. bytes 0: to the end (of a texel buffer: its last
/// texel may reach beyond Buffer::bytes).
struct Binding {
    std::string_view name;
    const Buffer* buffer = nullptr;
    Texel texel = Texel::rgba32_float;
    uint64_t offset = 0;
    uint64_t bytes = 0;
};

/// A specialization constant by its constant_id.
struct Constant {
    uint32_t id = 0;
    uint32_t value = 0;
};

struct StageTime {
    std::string name;
    double seconds = 0.0;
    uint64_t dispatches = 0;
    double marked_seconds = 0.0;  ///< Of `seconds`, those of commands that were recorded while Recorder::mark was on.
};

std::vector<DeviceDescription> list_devices();
std::vector<std::string> loader_errors();

class Recorder;

class Device {
public:
    /// See gnomon::Renderer. With validate, every message of the layer (synchronization validation included) is collected, and
    /// thrown as ErrorKind::internal from the next submit; also see validation_messages().
    /// For tests, the environment variable GNOMON_LIMITS lowers limits, as if devices had no more:
    /// "texels=65536,texel_reads=0,crew=2,shuffles=0,storage_range=16777216,storage_buffers=4,push_constants=128,groups=65535,
    /// buffer=67108864,dispatch_ms=1,timestamps=0,mapped=0", in any number and order. Errors: ErrorKind::usage for others, and
    /// for values above a device's own; of list_devices, too.
    Device(const std::string& choice, bool validate);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceDescription& description() const;
    const Limits& limits() const;
    /// Whether stage times are measured; else their seconds are 0.
    bool has_timestamps() const;
    const std::vector<std::string>& validation_messages() const;

    /// The recorder that all stages share: commands wait in it until somebody needs a result, at the latest until another
    /// recorder submits. upload, download and what is made of them go through it.
    Recorder& recorder();

    /// Uninitialised memory, usable for storage, texel, uniform and transfer. bytes 0 gives the smallest buffer. Where the
    /// budget would be passed, what waits in the recorder is run first, so that what only it still needs is given back.
    /// Errors: ErrorKind::out_of_memory naming the buffer and its size; also when the budget would be passed.
    Buffer allocate(const std::string& name, uint64_t bytes);

    /// Bytes of buffers that may be allocated at one time; 0: no limit. Memory of buffers that are gone is kept for later ones
    /// while all of it is within the budget, or without one within half the largest heap, and given back where an allocation
    /// would fail without it. Where upload and download have to stage, they use 32 MiB of host memory for each recorder of one
    /// time besides.
    void set_budget(uint64_t bytes);
    uint64_t budget() const;       ///< All that there is where none was set.
    uint64_t budget_left() const;  ///< Of it.
    uint64_t live_bytes() const;
    uint64_t peak_bytes() const;
    std::map<std::string, uint64_t> largest_bytes() const;  ///< By buffer name.

    /// Errors: ErrorKind::internal for a constant that the shader does not have, and for a shader with resources other than
    /// storage buffers, uniform buffers and (u)samplerBuffers in set 0; no_device if it needs more than the device allows.
    Program program(const Shader& shader, std::span<const Constant> constants = {});

    /// Stage times since the last reset, in order of first use.
    std::vector<StageTime> stage_times() const;
    /// Of all that ran as one, a dispatch or a piece of one, since the last reset. Without timestamps an estimate.
    double longest_dispatch_seconds() const;
    uint64_t submissions() const;  ///< Since the last reset; each is waited for.
    /// From now on called after each submission, at most about a quarter of a second apart while the device works. What it
    /// throws comes out of what submitted; what was recorded is forgotten.
    void on_submission(std::function<void()> call);
    void reset_statistics();  ///< Stage times, longest dispatch, submissions; peak and largest bytes are those of now.

    struct Impl;
    const std::shared_ptr<Impl>& impl() const { return impl_; }

private:
    std::shared_ptr<Impl> impl_;
    std::unique_ptr<Recorder> recorder_;
};

/// What a Recorder's download() reads.
class Download {
public:
    /// Errors: ErrorKind::internal before the recorder's submit(), and if that failed.
    std::span<const std::byte> bytes() const;
    bool ready() const;  ///< The bytes are there.
    /// The bytes as values of type T; a part of one at the end is left out.
    template <class T>
    std::vector<T> values() const {
        const std::span<const std::byte> from = bytes();
        std::vector<T> to(from.size() / sizeof(T));
        if (!to.empty()) std::memcpy(to.data(), from.data(), to.size() * sizeof(T));
        return to;
    }

    struct State;

private:
    friend class Recorder;
    std::shared_ptr<State> state_;
};

/// Records stages into one command buffer, with debug labels and timestamps, and runs them. A command waits for those before it
/// only where they wrote what it reads or writes, or read what it writes, of the same bytes of a buffer; readonly blocks,
/// uniform blocks and texel buffers are only read. Others may overlap, and then the time counts to the stage that was recorded
/// first: what a stage takes is from when all before it is done until it is done, and the times of all stages add up to what
/// all took. A Recorder may be used again after submit().
class Recorder {
public:
    explicit Recorder(Device& device);
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Run `groups` workgroups. They are spread over x and y (at most max_groups each), so the shader numbers them
    /// gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x and ignores those past the count that it gets in its
    /// parameters; the number of rows, gl_NumWorkGroups.y, means nothing to it. So that no device is stopped for working too
    /// long at one thing, what may take more than dispatch_ms runs in pieces of whole rows, one after the other; what was
    /// recorded before may have to run for that (and be waited for) while this is recorded. Every resource of the program must
    /// be bound by name, every binding must exist in it, ranges must be within the limits and may overlap in one buffer only
    /// where neither is of a storage block that may be written (all but readonly ones), and the size of params must equal the
    /// push-constant block's: else ErrorKind::internal. groups 0: checked, but nothing is recorded.
    template <class Params>
    void dispatch(std::string_view stage, const Program& program, std::span<const Binding> bindings, const Params& params,
                  uint64_t groups) {
        dispatch_bytes(stage, program, bindings, std::as_bytes(std::span(&params, 1)), groups);
    }
    void dispatch_bytes(std::string_view stage, const Program& program, std::span<const Binding> bindings,
                        std::span<const std::byte> params, uint64_t groups);

    /// As dispatch, with the numbers of workgroups (x, y, 1) that are in `arguments` at `offset`, a multiple of 4, when it is
    /// run. Whoever writes them keeps to max_groups along x and y, and to most_groups in all: for more, submit() throws
    /// ErrorKind::internal. The shader numbers its workgroups as in dispatch. Where most_groups may take longer than
    /// dispatch_ms the host reads the arguments first, so most_groups should not be much more than there are. The arguments may
    /// not be in a range that the shader may write.
    template <class Params>
    void dispatch_indirect(std::string_view stage, const Program& program, std::span<const Binding> bindings,
                           const Params& params, const Buffer& arguments, uint64_t offset, uint64_t most_groups) {
        dispatch_indirect_bytes(stage, program, bindings, std::as_bytes(std::span(&params, 1)), arguments, offset, most_groups);
    }
    void dispatch_indirect_bytes(std::string_view stage, const Program& program, std::span<const Binding> bindings,
                                 std::span<const std::byte> params, const Buffer& arguments, uint64_t offset,
                                 uint64_t most_groups);

    /// Copies between the host and a buffer, in their order among the commands; many are served by one submission. `data` is
    /// free when upload returns. On devices whose buffers are mapped a buffer that this recorder did not use yet is written at
    /// once: other recorders may not have work that waits to use it. Copies are no stage. Errors: ErrorKind::internal for bytes
    /// past the end.
    void upload(const Buffer& buffer, std::span<const std::byte> data, uint64_t offset = 0);
    Download download(const Buffer& buffer, uint64_t offset, uint64_t bytes);
    /// The same to `data`, at once: submits.
    void download(const Buffer& buffer, std::span<std::byte> data, uint64_t offset);
    /// The bytes from `offset` on go one after the other to each of `parts`; at once: submits.
    void download(const Buffer& buffer, std::span<const std::span<std::byte>> parts, uint64_t offset);

    /// vkCmdFillBuffer; bytes 0: to the end. offset and bytes are multiples of 4.
    void fill(std::string_view stage, const Buffer& buffer, uint32_t value, uint64_t offset = 0, uint64_t bytes = 0);
    void copy(std::string_view stage, const Buffer& from, uint64_t from_offset, const Buffer& to, uint64_t to_offset,
              uint64_t bytes);

    /// From here on commands count to StageTime::marked_seconds too, or do so no more. Returns what it was.
    bool mark(bool on);

    /// Run what was recorded and wait. Errors: ErrorKind::device_lost, out_of_memory; internal for validation messages.
    void submit();

    struct Impl;

private:
    friend class Device;
    std::unique_ptr<Impl> impl_;
};

/// What a download of the device's recorder reads; the recorder runs first where it has to.
template <class T>
std::vector<T> values_of(Device& device, const Download& download) {
    if (!download.ready()) device.recorder().submit();
    return download.values<T>();
}

/// Write to a buffer, in its order among the commands of the device's recorder; read from it after all of them.
void upload(Device& device, const Buffer& buffer, std::span<const std::byte> data, uint64_t offset = 0);
void download(Device& device, const Buffer& buffer, std::span<std::byte> data, uint64_t offset = 0);

template <class T>
Buffer upload_new(Device& device, const std::string& name, const std::vector<T>& data) {
    Buffer buffer = device.allocate(name, data.size() * sizeof(T));
    if (!data.empty()) upload(device, buffer, std::as_bytes(std::span(data)));
    return buffer;
}

template <class T>
std::vector<T> download_vector(Device& device, const Buffer& buffer, uint64_t count, uint64_t offset = 0) {
    std::vector<T> data(count);
    if (count > 0) download(device, buffer, std::as_writable_bytes(std::span(data)), offset);
    return data;
}

}  // namespace gnomon::gpu
