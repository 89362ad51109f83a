// SPDX-License-Identifier: Apache-2.0
// Stages on the device: results, limits, errors in bindings, statistics.
#include <utility>

#include "gpu_test.hpp"
#include "gpu_test_count_groups.spv.h"
#include "gpu_test_declarations.spv.h"
#include "gpu_test_read_write.spv.h"
#include "gpu_test_scale.spv.h"

namespace gnomon::gpu {
namespace {

struct ScaleParams {
    uint32_t count;
    float factor;
};

constexpr uint32_t kLocalSize = 32;

class RecorderTest : public DeviceTest {
protected:
    void dispatch(const std::vector<Binding>& bindings, const ScaleParams& params = {4, 2.0f}, uint64_t groups = 1) {
        recorder.dispatch("test/scale", scale, bindings, params, groups);
    }

    void expect_rejected(const std::vector<Binding>& bindings, std::vector<std::string> parts) {
        parts.emplace_back("test/scale");
        expect_error(ErrorKind::internal, parts, [&] { dispatch(bindings); });
    }

    std::vector<Constant> constants{{0, kLocalSize}};
    Program scale = device.program({"scale", gpu_test_scale}, constants);
    Buffer values = upload_new(device, "values", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
    Buffer scaled = upload_new(device, "scaled", std::vector<float>(8, -1.0f));
    Binding values_binding{.name = "values", .buffer = &values, .texel = Texel::r32_float};
    Binding scaled_binding{.name = "Scaled", .buffer = &scaled};
    Recorder recorder{device};
};

TEST_F(RecorderTest, ReadsTexelsWritesStorage) {
    dispatch({values_binding, scaled_binding});
    recorder.submit();
    EXPECT_THAT(download_vector<float>(device, scaled, 8), testing::ElementsAre(7, 9, 11, 13, -1, -1, -1, -1));
}

TEST_F(RecorderTest, SpecializationConstantsReplaceDefaults) {
    constants.push_back({1, 100});
    scale = device.program({"scale", gpu_test_scale}, constants);
    dispatch({scaled_binding, values_binding});
    recorder.submit();
    EXPECT_THAT(download_vector<float>(device, scaled, 4), testing::ElementsAre(102, 104, 106, 108));
}

TEST_F(RecorderTest, BindsRanges) {
    const uint64_t offset = std::max(device.limits().texel_alignment, device.limits().storage_alignment);
    const auto skip = static_cast<uint32_t>(offset / sizeof(float));
    std::vector<float> input(skip + 2, 0.0f);
    input[skip] = 10.0f;
    input[skip + 1] = 20.0f;
    const Buffer in = upload_new(device, "in", input);
    const Buffer out = upload_new(device, "out", std::vector<float>(skip + 2, -1.0f));
    dispatch({{.name = "values", .buffer = &in, .texel = Texel::r32_float, .offset = offset, .bytes = 8},
              {.name = "Scaled", .buffer = &out, .offset = offset, .bytes = 8}},
             {2, 1.0f});
    recorder.submit();
    EXPECT_THAT(download_vector<float>(device, out, 2, offset), testing::ElementsAre(15, 25));
    EXPECT_EQ(download_vector<float>(device, out, 1)[0], -1.0f);
}

TEST_F(RecorderTest, TexelFormatsOfOneBufferDiffer) {
    values_binding.texel = Texel::rg32_float;
    dispatch({values_binding, scaled_binding});
    recorder.submit();
    EXPECT_THAT(download_vector<float>(device, scaled, 4), testing::ElementsAre(7, 11, 15, 19));
    values_binding.texel = Texel::rgba32_float;
    dispatch({values_binding, scaled_binding}, {2, 2.0f});
    recorder.submit();
    EXPECT_THAT(download_vector<float>(device, scaled, 2), testing::ElementsAre(7, 15));
}

// Each stage reads through texels what the one before wrote as storage.
TEST_F(RecorderTest, StagesSeeWhatStagesBeforeWrote) {
    Buffer other = device.allocate("other", scaled.bytes());
    for (int i = 0; i < 5; ++i) {
        const Buffer& from = i % 2 == 0 ? values : other;
        const Buffer& to = i % 2 == 0 ? other : values;
        dispatch({{.name = "values", .buffer = &from, .texel = Texel::r32_float}, {.name = "Scaled", .buffer = &to}},
                 {8, 2.0f});
    }
    recorder.submit();
    std::vector<float> expected{1, 2, 3, 4, 5, 6, 7, 8};
    for (float& value : expected) {
        for (int i = 0; i < 5; ++i) value = value * 2.0f + 5.0f;
    }
    EXPECT_EQ(download_vector<float>(device, other, 8), expected);
}

TEST_F(RecorderTest, GroupsSpreadOverTwoAxes) {
    const Program program = device.program({"count_groups", gpu_test_count_groups});
    for (const uint32_t groups : {1u, 65535u, 65536u, 140001u}) {
        const Buffer visits = device.allocate("visits", (groups + 1) * sizeof(uint32_t));
        const std::vector<Binding> bindings{{.name = "Visits", .buffer = &visits}};
        recorder.fill("clear", visits, 0);
        recorder.dispatch("count", program, bindings, groups, groups);
        recorder.submit();
        std::vector<uint32_t> counts = download_vector<uint32_t>(device, visits, groups + 1);
        EXPECT_LE(counts.back(), groups / 32) << "groups that have nothing to do";
        counts.pop_back();
        EXPECT_EQ(counts, std::vector<uint32_t>(groups, 1)) << groups;
    }
}

TEST_F(RecorderTest, TooManyGroupsIsAnError) {
    const uint64_t most = device.limits().max_groups;
    expect_error(ErrorKind::internal, {"test/scale", "workgroups"}, [&] {
        dispatch({values_binding, scaled_binding}, {4, 2.0f}, most * most + 1);
    });
}

TEST_F(RecorderTest, NoGroupsRecordNothingButAreChecked) {
    dispatch({values_binding, scaled_binding}, {4, 2.0f}, 0);
    recorder.submit();
    EXPECT_THAT(device.stage_times(), testing::IsEmpty());
    EXPECT_EQ(download_vector<float>(device, scaled, 1)[0], -1.0f);
    expect_error(ErrorKind::internal, {"'Scaled' is not bound"}, [&] { dispatch({values_binding}, {4, 2.0f}, 0); });
}

TEST_F(RecorderTest, WrongBindingsAreNamed) {
    const Buffer empty;
    const Buffer nine = device.allocate("nine", 9 * 16);
    expect_rejected({values_binding}, {"'Scaled' is not bound"});
    expect_rejected({values_binding, scaled_binding, {.name = "Extra", .buffer = &values}}, {"no resource 'Extra'"});
    expect_rejected({values_binding, scaled_binding, values_binding}, {"'values' is bound twice"});
    expect_rejected({values_binding, {.name = "Scaled"}}, {"'Scaled' is bound to no buffer"});
    expect_rejected({values_binding, {.name = "Scaled", .buffer = &empty}}, {"'Scaled' is an empty buffer"});
    expect_rejected({values_binding, {.name = "Scaled", .buffer = &scaled, .offset = 1}}, {"'Scaled'", "multiple"});
    expect_rejected({values_binding, {.name = "Scaled", .buffer = &scaled, .bytes = 33}}, {"'Scaled'", "end at 32"});
    expect_rejected({values_binding, {.name = "Scaled", .buffer = &scaled, .offset = 1024}}, {"'Scaled'", "end at 32"});
    expect_rejected({values_binding, {.name = "Scaled", .buffer = &scaled, .bytes = ~uint64_t{0}}}, {"'Scaled'", "end at 32"});
    expect_rejected({{.name = "values", .buffer = &values, .texel = Texel::r32_uint}, scaled_binding},
                    {"'values'", "samplerBuffer"});
    expect_rejected({{.name = "values", .buffer = &nine, .bytes = 24}, scaled_binding}, {"'values'", "whole texels of 16"});
    expect_rejected({{.name = "values", .buffer = &values, .offset = 1}, scaled_binding}, {"'values'", "multiple"});
    recorder.submit();
    EXPECT_THAT(device.stage_times(), testing::IsEmpty());
}

TEST_F(RecorderTest, RangesBeyondTheLimitsAreErrors) {
    const Limits& limits = device.limits();
    if (limits.max_storage_range + 16 > limits.max_buffer_bytes) GTEST_SKIP() << "skipped: no buffer is larger than a binding";
    const Buffer large = device.allocate("large", limits.max_storage_range + 16);
    expect_rejected({values_binding, {.name = "Scaled", .buffer = &large}}, {"'Scaled'", "large", "bands"});
    dispatch({values_binding, {.name = "Scaled", .buffer = &large, .bytes = 64}});
    if (limits.max_texels * 4 + 16 > limits.max_buffer_bytes) GTEST_SKIP() << "skipped: no buffer has too many texels";
    const Buffer texels = device.allocate("texels", limits.max_texels * 4 + 16);
    expect_rejected({{.name = "values", .buffer = &texels, .texel = Texel::r32_float}, scaled_binding},
                    {"'values'", "texels", "bands"});
}

TEST_F(RecorderTest, BlocksSmallerThanTheShadersAreErrors) {
    const Program program = device.program({"declarations", gpu_test_declarations});
    const std::vector<Binding> bindings{{.name = "Settings", .buffer = &values, .bytes = 12},
                                        {.name = "ids", .buffer = &values, .texel = Texel::r32_uint},
                                        {.name = "points", .buffer = &values},
                                        {.name = "Header", .buffer = &values},
                                        {.name = "Sums", .buffer = &scaled}};
    expect_error(ErrorKind::internal, {"'Settings'", "12", "16"},
                 [&] { recorder.dispatch("test/declarations", program, bindings, std::array<std::byte, 124>{}, 1); });
}

// The device may take what is bound twice for different memory.
TEST_F(RecorderTest, WrittenRangesMayNotBeBoundTwice) {
    const Program program = device.program({"read_write", gpu_test_read_write});
    const uint64_t part = std::max<uint64_t>(256, device.limits().storage_alignment);
    const Buffer shared = upload_new(device, "shared", std::vector<uint32_t>(2 * part / sizeof(uint32_t), 3));
    const Buffer mixed = device.allocate("mixed", 64);
    const Buffer sums = device.allocate("sums", 64);
    const std::vector<Binding> apart{{.name = "texels", .buffer = &shared, .texel = Texel::r32_uint, .bytes = part},
                                     {.name = "Input", .buffer = &shared, .bytes = part},
                                     {.name = "Settings", .buffer = &shared, .bytes = 16},
                                     {.name = "Mixed", .buffer = &mixed},
                                     {.name = "Sums", .buffer = &sums}};
    const auto dispatch_with = [&](size_t i, const Binding& changed) {
        std::vector<Binding> bindings = apart;
        bindings[i] = changed;
        recorder.dispatch_bytes("test/read_write", program, bindings, {}, 1);
    };
    const auto expect_alias = [&](size_t i, const Binding& changed, const std::vector<std::string>& parts) {
        expect_error(ErrorKind::internal, parts, [&] { dispatch_with(i, changed); });
    };
    EXPECT_NO_THROW(dispatch_with(0, apart[0])) << "three read-only bindings of one range";
    EXPECT_NO_THROW(dispatch_with(4, {.name = "Sums", .buffer = &shared, .offset = part})) << "ranges that touch";
    expect_alias(4, {.name = "Sums", .buffer = &shared, .bytes = 64}, {"test/read_write", "'texels'", "'Sums'", "shared"});
    expect_alias(4, {.name = "Sums", .buffer = &mixed}, {"'Mixed'", "'Sums'", "buffer mixed"});
    expect_alias(3, {.name = "Mixed", .buffer = &sums}, {"'Mixed'", "'Sums'", "buffer sums"});
    expect_alias(1, {.name = "Input", .buffer = &sums}, {"'Input'", "'Sums' may be written"});
    expect_alias(2, {.name = "Settings", .buffer = &mixed}, {"'Settings'", "'Mixed' may be written"});
    expect_alias(0, {.name = "texels", .buffer = &sums, .texel = Texel::r32_uint}, {"'texels'", "'Sums' may be written"});
    recorder.submit();
    EXPECT_THAT(download_vector<uint32_t>(device, sums, 8), testing::Each(12u));
}

TEST_F(RecorderTest, ParametersMustFitTheShader) {
    const std::vector<Binding> bindings{values_binding, scaled_binding};
    expect_error(ErrorKind::internal, {"test/scale", "4 bytes of parameters", "8"},
                 [&] { recorder.dispatch("test/scale", scale, bindings, uint32_t{4}, 1); });
    expect_error(ErrorKind::internal, {"test/scale", "0 bytes"},
                 [&] { recorder.dispatch_bytes("test/scale", scale, bindings, {}, 1); });
    expect_error(ErrorKind::internal, {"test/scale", "program is empty"},
                 [&] { recorder.dispatch("test/scale", Program(), bindings, ScaleParams{}, 1); });
}

TEST_F(RecorderTest, ConstantsThatTheShaderLacksAreErrors) {
    constants.push_back({9, 1});
    expect_error(ErrorKind::internal, {"specialization constant 9", "scale"}, [&] {
        device.program({"scale", gpu_test_scale}, constants);
    });
}

TEST_F(RecorderTest, WorkgroupsLargerThanTheDevicesAreErrors) {
    constants = {{0, 1u << 30}};
    expect_error(ErrorKind::no_device, {"invocations", "scale"}, [&] { device.program({"scale", gpu_test_scale}, constants); });
}

TEST_F(RecorderTest, FillsAndCopies) {
    const Buffer numbers = upload_new(device, "numbers", iota(8));
    const Buffer target = upload_new(device, "target", iota(8, 100));
    recorder.fill("fill", numbers, 7, 24);
    recorder.fill("fill", numbers, 9, 4, 8);
    recorder.copy("copy", numbers, 0, target, 8, 20);
    recorder.copy("copy", target, 0, target, 28, 4);
    recorder.copy("copy", target, 0, target, 4, 0);
    recorder.submit();
    EXPECT_THAT(download_vector<uint32_t>(device, numbers, 8), testing::ElementsAre(0, 9, 9, 3, 4, 5, 7, 7));
    EXPECT_THAT(download_vector<uint32_t>(device, target, 8), testing::ElementsAre(100, 101, 0, 9, 9, 3, 4, 100));

    expect_error(ErrorKind::internal, {"clear", "numbers", "multiple of 4"}, [&] { recorder.fill("clear", numbers, 0, 2); });
    expect_error(ErrorKind::internal, {"clear", "numbers"}, [&] { recorder.fill("clear", numbers, 0, 0, 6); });
    expect_error(ErrorKind::internal, {"clear", "numbers", "end at 32"}, [&] { recorder.fill("clear", numbers, 0, 28, 8); });
    expect_error(ErrorKind::internal, {"move", "numbers"}, [&] { recorder.copy("move", numbers, 16, target, 0, 20); });
    expect_error(ErrorKind::internal, {"move", "target"}, [&] { recorder.copy("move", numbers, 0, target, 16, 20); });
    expect_error(ErrorKind::internal, {"move", "overlap"}, [&] { recorder.copy("move", numbers, 0, numbers, 8, 12); });
    expect_error(ErrorKind::internal, {"move", "empty"}, [&] { recorder.copy("move", Buffer(), 0, numbers, 8, 12); });
}

TEST_F(RecorderTest, StageTimesAddUpByStage) {
    dispatch({values_binding, scaled_binding});
    recorder.fill("clear", scaled, 0);
    dispatch({values_binding, scaled_binding});
    recorder.submit();
    dispatch({values_binding, scaled_binding});
    recorder.submit();
    const std::vector<StageTime> times = device.stage_times();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "test/scale");
    EXPECT_EQ(times[0].dispatches, 3u);
    EXPECT_GT(times[0].seconds, 0.0);
    EXPECT_LT(times[0].seconds, 60.0);
    EXPECT_EQ(times[1].name, "clear");
    EXPECT_EQ(times[1].dispatches, 1u);
    device.reset_statistics();
    EXPECT_THAT(device.stage_times(), testing::IsEmpty());
}

// More than a query pool's timestamps and a descriptor pool's sets, twice.
TEST_F(RecorderTest, ThousandsOfCommandsInOneSubmit) {
    const Program program = device.program({"count_groups", gpu_test_count_groups});
    const Buffer visits = upload_new(device, "visits", std::vector<uint32_t>(1, 0));
    const std::vector<Binding> bindings{{.name = "Visits", .buffer = &visits}};
    for (int round = 0; round < 2; ++round) {
        for (int i = 0; i < 2500; ++i) recorder.dispatch("count", program, bindings, uint32_t{1}, 1);
        recorder.submit();
    }
    EXPECT_EQ(download_vector<uint32_t>(device, visits, 1)[0], 5000u);
    EXPECT_EQ(device.stage_times().at(0).dispatches, 5000u);
}

TEST_F(RecorderTest, KeepsWhatItRecordedAlive) {
    const Buffer result = device.allocate("result", 32);
    {
        const Buffer gone = upload_new(device, "gone", std::vector<float>(8, 3.0f));
        device.recorder().submit();  // Else it may hold what it uploads.
        const Program other = device.program({"scale", gpu_test_scale}, constants);
        const std::vector<Binding> bindings{{.name = "values", .buffer = &gone, .texel = Texel::r32_float},
                                            {.name = "Scaled", .buffer = &result}};
        recorder.dispatch("test/scale", other, bindings, ScaleParams{8, 1.0f}, 1);
    }
    const uint64_t before = device.live_bytes();
    recorder.submit();
    EXPECT_EQ(device.live_bytes(), before - 32);
    EXPECT_THAT(download_vector<float>(device, result, 8), testing::Each(8.0f));
}

// Command buffers are lent: one comes back from a recorder that never ran, and two are out at a time.
TEST_F(RecorderTest, CommandBuffersComeBackEmpty) {
    Buffer numbers = device.allocate("numbers", 16);
    recorder.fill("fill", numbers, 1);
    {
        Recorder never_run(device);
        never_run.fill("fill", numbers, 2);
    }
    recorder.submit();
    Recorder next(device);
    next.fill("fill", numbers, 3, 8);
    next.submit();
    EXPECT_EQ(download_vector<uint32_t>(device, numbers, 4), (std::vector<uint32_t>{1, 1, 3, 3}));
    EXPECT_THAT(device.validation_messages(), testing::IsEmpty());
}

TEST_F(RecorderTest, MovesItsPrograms) {
    Program moved = std::move(scale);
    EXPECT_FALSE(scale);
    scale = std::move(moved);
    dispatch({values_binding, scaled_binding});
    recorder.submit();
    EXPECT_EQ(download_vector<float>(device, scaled, 1)[0], 7.0f);
}

TEST_F(RecorderTest, RejectsWhatIsOfAnotherDevice) {
    Device other("", false);
    const Buffer foreign = other.allocate("foreign", 64);
    expect_rejected({values_binding, {.name = "Scaled", .buffer = &foreign}}, {"'Scaled'", "another device"});
    scale = other.program({"scale", gpu_test_scale}, constants);
    expect_rejected({values_binding, scaled_binding}, {"'scale'", "another device"});
}

}  // namespace
}  // namespace gnomon::gpu
