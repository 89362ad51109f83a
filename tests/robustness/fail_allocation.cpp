// SPDX-License-Identifier: Apache-2.0
// For LD_PRELOAD: lets one allocation of the program fail, or all from one on. The environment says which:
//   FAIL_ALLOCATION         device: vkAllocateMemory; host: operator new, of the program's own code and of what libstdc++ does
//   for it FAIL_ALLOCATION_FIRST   the number of the first that fails, from 1; 0: none FAIL_ALLOCATION_COUNT   how many fail;
//   empty: all from there on FAIL_ALLOCATION_REPORT  a file; it is told how many allocations there were
// What libraries allocate for themselves is left alone: LLVM, which compiles lavapipe's code, ends the process where it gets no
// memory. So is what happens before main(), where nobody could catch it.
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>

namespace {

struct Range {
    uintptr_t begin = 0, end = 0;
    bool holds(const void* address) const {
        const auto at = reinterpret_cast<uintptr_t>(address);
        return at >= begin && at < end;
    }
};

std::array<Range, 4> ours;  // The program, libstdc++, libc and this library.
bool device = false, host = false;
uint64_t first = 0, count = 0;
std::atomic<uint64_t> allocations{0};
int (*real_main)(int, char**, char**) = nullptr;

bool is_due() {
    const uint64_t number = ++allocations;
    return first > 0 && number >= first && number - first < count;
}

// Addresses of libraries begin and end with their segments.
int find_ranges(dl_phdr_info* info, size_t, void*) {
    Range range{std::numeric_limits<uintptr_t>::max(), 0};
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        const auto& segment = info->dlpi_phdr[i];
        if (segment.p_type != PT_LOAD) continue;
        range.begin = std::min<uintptr_t>(range.begin, info->dlpi_addr + segment.p_vaddr);
        range.end = std::max<uintptr_t>(range.end, info->dlpi_addr + segment.p_vaddr + segment.p_memsz);
    }
    if (ours[0].end == 0) ours[0] = range;  // The program is the first.
    if (std::strstr(info->dlpi_name, "/libstdc++.so") != nullptr) ours[1] = range;
    if (std::strstr(info->dlpi_name, "/libc.so") != nullptr) ours[2] = range;
    if (range.holds(reinterpret_cast<const void*>(&is_due))) ours[3] = range;
    return 0;
}

bool is_ours(const void* address) {
    return std::any_of(ours.begin(), ours.end(), [=](const Range& range) { return range.holds(address); });
}

// Nothing else may be on the stack: libraries use the program's copies of templates such as std::string's.
bool is_the_programs(const void* caller) {
    if (!is_ours(caller)) return false;
    std::array<void*, 128> frames{};
    const int depth = backtrace(frames.data(), frames.size());
    return std::all_of(frames.begin(), frames.begin() + depth, is_ours);
}

void* allocate(size_t bytes, size_t alignment, const void* caller) {
    if (host && is_the_programs(caller) && is_due()) return nullptr;
    const size_t least = bytes == 0 ? 1 : bytes;
    return alignment == 0 ? std::malloc(least) : std::aligned_alloc(alignment, (least + alignment - 1) / alignment * alignment);
}

void* allocate_or_throw(size_t bytes, size_t alignment, const void* caller) {
    void* memory = allocate(bytes, alignment, caller);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

uint64_t number(const char* name, uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr && *text != '\0' ? std::strtoull(text, nullptr, 10) : otherwise;
}

int watched_main(int argc, char** argv, char** environment) {
    const char* what = std::getenv("FAIL_ALLOCATION");
    first = number("FAIL_ALLOCATION_FIRST", 0);
    count = number("FAIL_ALLOCATION_COUNT", std::numeric_limits<uint64_t>::max());
    dl_iterate_phdr(find_ranges, nullptr);
    std::array<void*, 1> frame{};
    backtrace(frame.data(), frame.size());  // The first time it loads a library.
    device = what != nullptr && std::strcmp(what, "device") == 0;
    host = what != nullptr && std::strcmp(what, "host") == 0;
    const int result = real_main(argc, argv, environment);
    host = device = false;
    if (const char* report = std::getenv("FAIL_ALLOCATION_REPORT")) {
        if (std::FILE* file = std::fopen(report, "w")) {
            std::fprintf(file, "%llu\n", static_cast<unsigned long long>(allocations.load()));
            std::fclose(file);
        }
    }
    return result;
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

#define GN_CALLER __builtin_return_address(0)

void* operator new(size_t bytes) { return allocate_or_throw(bytes, 0, GN_CALLER); }
void* operator new[](size_t bytes) { return allocate_or_throw(bytes, 0, GN_CALLER); }
void* operator new(size_t bytes, std::align_val_t to) { return allocate_or_throw(bytes, static_cast<size_t>(to), GN_CALLER); }
void* operator new[](size_t bytes, std::align_val_t to) { return allocate_or_throw(bytes, static_cast<size_t>(to), GN_CALLER); }
void* operator new(size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, 0, GN_CALLER); }
void* operator new[](size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, 0, GN_CALLER); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

extern "C" {

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateMemory(VkDevice of, const VkMemoryAllocateInfo* info,
                                                const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
    if (device && is_due()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return next<PFN_vkAllocateMemory>("vkAllocateMemory")(of, info, callbacks, memory);
}

int __libc_start_main(int (*program_main)(int, char**, char**), int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
    real_main = program_main;
    return next<decltype(&__libc_start_main)>("__libc_start_main")(watched_main, argc, argv, init, fini, rtld_fini, stack_end);
}
}
