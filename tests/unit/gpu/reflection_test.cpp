// SPDX-License-Identifier: Apache-2.0
// What the reflection finds in SPIR-V, against the sources of the shaders; no device is needed.
#include "gpu/reflection.hpp"

#include "gpu_test.hpp"
#include "gpu_test_array_of_blocks.spv.h"
#include "gpu_test_declarations.spv.h"
#include "gpu_test_local_size.spv.h"
#include "gpu_test_read_write.spv.h"
#include "gpu_test_scale.spv.h"
#include "gpu_test_second_set.spv.h"
#include "gpu_test_storage_image.spv.h"

namespace gnomon::gpu {
namespace {

const Resource& find(const Reflection& reflection, const std::string& name) {
    for (const Resource& resource : reflection.resources) {
        if (resource.name == name) return resource;
    }
    throw std::runtime_error("no resource " + name);
}

void expect_resource(const Reflection& reflection, const std::string& name, ResourceKind kind, uint32_t binding,
                     uint64_t min_bytes) {
    const Resource& resource = find(reflection, name);
    EXPECT_EQ(resource.kind, kind) << name;
    EXPECT_EQ(resource.binding, binding) << name;
    EXPECT_EQ(resource.min_bytes, min_bytes) << name;
}

TEST(Reflection, FindsEveryKindOfResource) {
    const Reflection reflection = reflect({"declarations", gpu_test_declarations}, {});
    ASSERT_EQ(reflection.resources.size(), 5u);
    expect_resource(reflection, "Settings", ResourceKind::uniform_buffer, 4, 16);
    expect_resource(reflection, "ids", ResourceKind::uint_texels, 2, 0);
    expect_resource(reflection, "points", ResourceKind::float_texels, 3, 0);
    expect_resource(reflection, "Header", ResourceKind::storage_buffer, 9, 12);
    expect_resource(reflection, "Sums", ResourceKind::storage_buffer, 0, 0);
}

TEST(Reflection, KnowsWhatMayBeWritten) {
    const Reflection reflection = reflect({"read_write", gpu_test_read_write}, {});
    EXPECT_FALSE(find(reflection, "texels").writable);
    EXPECT_FALSE(find(reflection, "Input").writable);
    EXPECT_FALSE(find(reflection, "Settings").writable);
    EXPECT_TRUE(find(reflection, "Mixed").writable);
    EXPECT_TRUE(find(reflection, "Sums").writable);
}

TEST(Reflection, SizesPushConstantsFromTheirMembers) {
    EXPECT_EQ(reflect({"declarations", gpu_test_declarations}, {}).push_constant_bytes, 124u);
    EXPECT_EQ(reflect({"scale", gpu_test_scale}, {}).push_constant_bytes, 8u);
    EXPECT_EQ(reflect({"local_size", gpu_test_local_size}, {}).push_constant_bytes, 0u);
}

TEST(Reflection, LocalSizeIsLiteralOrSpecialized) {
    using Size = std::array<uint32_t, 3>;
    EXPECT_EQ(reflect({"declarations", gpu_test_declarations}, {}).local_size, (Size{8, 4, 2}));
    EXPECT_EQ(reflect({"local_size", gpu_test_local_size}, {}).local_size, (Size{4, 1, 2}));
    const std::vector<Constant> constants{{3, 6}};
    EXPECT_EQ(reflect({"local_size", gpu_test_local_size}, constants).local_size, (Size{4, 6, 2}));
}

TEST(Reflection, KnowsTheConstants) {
    const Shader shader{"declarations", gpu_test_declarations};
    EXPECT_NO_THROW(reflect(shader, std::vector<Constant>{{7, 0}}));
    expect_error(ErrorKind::internal, {"specialization constant 8", "declarations"}, [&] {
        reflect(shader, std::vector<Constant>{{8, 0}});
    });
    expect_error(ErrorKind::internal, {"specialization constant 7", "twice"}, [&] {
        reflect(shader, std::vector<Constant>{{7, 0}, {7, 1}});
    });
}

TEST(Reflection, RejectsOtherResources) {
    expect_error(ErrorKind::internal, {"picture", "storage_image"}, [] {
        reflect({"storage_image", gpu_test_storage_image}, {});
    });
    expect_error(ErrorKind::internal, {"set 0", "second_set"}, [] { reflect({"second_set", gpu_test_second_set}, {}); });
    expect_error(ErrorKind::internal, {"blocks", "array_of_blocks"}, [] {
        reflect({"array_of_blocks", gpu_test_array_of_blocks}, {});
    });
}

TEST(Reflection, RejectsBrokenModules) {
    const std::vector<uint32_t> whole(std::begin(gpu_test_declarations), std::end(gpu_test_declarations));
    expect_error(ErrorKind::internal, {"not a SPIR-V module", "empty"}, [] { reflect({"empty", {}}, {}); });
    std::vector<uint32_t> other_magic = whole;
    other_magic[0] ^= 1u;
    expect_error(ErrorKind::internal, {"not a SPIR-V module"}, [&] { reflect({"magic", other_magic}, {}); });
    std::vector<uint32_t> long_instruction = whole;
    long_instruction[5] |= 0xffff0000u;
    expect_error(ErrorKind::internal, {"past the end"}, [&] { reflect({"long", long_instruction}, {}); });
    // Cut anywhere, a module is read or rejected, never read past its end.
    for (size_t words = 0; words < whole.size(); ++words) {
        const std::vector<uint32_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(words));
        try {
            reflect({"cut", cut}, {});
        } catch (const Error& error) {
            ASSERT_EQ(error.kind(), ErrorKind::internal);
        }
    }
}

}  // namespace
}  // namespace gnomon::gpu
