// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: checks of what a stage is given. All errors are ErrorKind::internal and name the stage and the resource.
#pragma once

#include "gpu/descriptors.hpp"

namespace gnomon::gpu {

[[noreturn]] void fail_stage(std::string_view stage, const std::string& what);

/// Errors: an empty buffer, another device's.
Buffer::Impl& checked_buffer(std::string_view stage, const Device::Impl& device, const Buffer& buffer, std::string_view name);

/// The bytes of a range that starts at `offset` and ends by `end`; bytes 0 stands for all up to the end.
/// Errors: past the end, empty, offset not a multiple of `alignment`.
uint64_t checked_range(std::string_view stage, const std::string& name, uint64_t offset, uint64_t bytes, uint64_t end,
                       uint64_t alignment);

/// For a transfer of these bytes. Errors: ErrorKind::internal, naming `what`, for an empty buffer, another device's, and bytes
/// past the end.
const std::shared_ptr<Buffer::Impl>& checked_transfer(const Device::Impl& device, const Buffer& buffer, uint64_t offset,
                                                      uint64_t bytes, const char* what);

/// The arguments (x, y, 1) of an indirect dispatch. Errors: more than `most_groups`, another z.
Grid checked_arguments(std::string_view stage, std::span<const std::byte> arguments, uint64_t most_groups);

/// One descriptor for each resource of the program. Errors: see Recorder::dispatch.
std::vector<Descriptor> bind_resources(std::string_view stage, const Program::Impl& program, std::span<const Binding> bindings);

}  // namespace gnomon::gpu
