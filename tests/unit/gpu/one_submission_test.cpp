// SPDX-License-Identifier: Apache-2.0
// Copies from and to the host among other commands, and workgroups whose number is known on the device only.
#include <array>

#include "gpu/recorder_impl.hpp"
#include "gpu_test.hpp"
#include "gpu_test_count_groups.spv.h"
#include "gpu_test_scale.spv.h"

namespace gnomon::gpu {
namespace {

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

struct ScaleParams {
    uint32_t count;
    float factor;
};

// The parameter: GNOMON_LIMITS.
class OneSubmission : public testing::TestWithParam<const char*> {
protected:
    void TearDown() override { EXPECT_THAT(device.validation_messages(), testing::IsEmpty()); }

    void dispatch_scale() {
        const std::vector<Binding> bindings{{.name = "values", .buffer = &values, .texel = Texel::r32_float},
                                            {.name = "Scaled", .buffer = &scaled}};
        recorder.dispatch("scale", scale, bindings, ScaleParams{4, 2.0f}, 4);
    }

    void dispatch_count(uint64_t most) {
        const std::vector<Binding> bindings{{.name = "Visits", .buffer = &visits}};
        recorder.dispatch_indirect("count", count_groups, bindings, kCount, arguments, 4, most);
    }

    static constexpr uint32_t kCount = 600;
    ScopedVariable limits{"GNOMON_LIMITS", GetParam()};
    Device device{"", true};
    Program scale = device.program({"scale", gpu_test_scale});
    Program count_groups = device.program({"count_groups", gpu_test_count_groups});
    Buffer values = upload_new(device, "values", std::vector<float>{1, 2, 3, 4});
    Buffer scaled = upload_new(device, "scaled", std::vector<float>(4, -1.0f));
    Buffer arguments = upload_new(device, "arguments", std::vector<uint32_t>{0, 20, 30, 1});
    Buffer visits = upload_new(device, "visits", std::vector<uint32_t>(kCount + 1, 0));
    Recorder recorder{device};
};

// More than the staging memory, by several threads.
TEST_P(OneSubmission, OneDownloadInSeveralParts) {
    std::vector<uint32_t> numbers(size_t{11} << 20);
    for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<uint32_t>(i * 2654435761u);
    const Buffer large = upload_new(device, "large", numbers);
    std::vector<uint32_t> read(numbers.size());
    const std::span<std::byte> all = std::as_writable_bytes(std::span(read));
    const std::array parts{all.first(12), all.subspan(12, 0), all.subspan(12, size_t{20} << 20),
                           all.subspan((size_t{20} << 20) + 12)};
    recorder.download(large, parts, 0);
    EXPECT_TRUE(read == numbers);
    expect_error(ErrorKind::internal, {"download", "large"}, [&] { recorder.download(large, parts, 4); });
}

TEST_P(OneSubmission, CopiesKeepTheirOrder) {
    recorder.upload(values, bytes_of(std::vector<float>{10, 20, 30, 40}));
    const Download values_before = recorder.download(values, 4, 8);
    dispatch_scale();
    const Download first = recorder.download(scaled, 0, 16);
    recorder.upload(values, bytes_of(std::vector<float>{7}), 8);
    dispatch_scale();
    const Download second = recorder.download(scaled, 0, 16);
    recorder.fill("clear", scaled, 0);
    const Download nothing = recorder.download(scaled, 16, 0);
    device.reset_statistics();
    recorder.submit();
    if (device.limits().dispatch_ms > 0) {
        EXPECT_EQ(device.submissions(), 1u);
    }
    EXPECT_THAT(values_before.values<float>(), testing::ElementsAre(20, 30));
    EXPECT_THAT(first.values<float>(), testing::ElementsAre(25, 45, 65, 85));
    EXPECT_THAT(second.values<float>(), testing::ElementsAre(25, 45, 19, 85));
    EXPECT_THAT(nothing.bytes(), testing::IsEmpty());
    EXPECT_THAT(download_vector<float>(device, scaled, 4), testing::Each(0.0f));
    const std::vector<StageTime> times = device.stage_times();
    ASSERT_EQ(times.size(), 2u) << "copies are no stage";
    EXPECT_EQ(times[0].dispatches, 2u);
}

TEST_P(OneSubmission, CopiesLargerThanTheStagingMemory) {
    const auto count = static_cast<uint32_t>(kStagingBytes / sizeof(uint32_t) * 5 / 2 + 3);
    const Buffer large = device.allocate("large", count * sizeof(uint32_t));
    recorder.fill("clear", large, 1);
    recorder.upload(large, bytes_of(iota(count)));
    const Download all = recorder.download(large, 0, large.bytes());
    const Download part = recorder.download(large, 400, 8);
    recorder.upload(large, bytes_of(iota(count, 5)));
    const Download again = recorder.download(large, 0, large.bytes());
    recorder.fill("clear", large, 2);
    recorder.submit();
    EXPECT_EQ(again.values<uint32_t>(), iota(count, 5));
    EXPECT_EQ(all.values<uint32_t>(), iota(count));
    EXPECT_THAT(part.values<uint32_t>(), testing::ElementsAre(100, 101));
    EXPECT_EQ(download_vector<uint32_t>(device, large, 1)[0], 2u);
}

TEST_P(OneSubmission, DownloadsAreReadAfterSubmit) {
    const Download early = recorder.download(scaled, 0, 16);
    expect_error(ErrorKind::internal, {"before it was submitted", "scaled"}, [&] { static_cast<void>(early.bytes()); });
    expect_error(ErrorKind::internal, {"empty download"}, [] { static_cast<void>(Download().bytes()); });
    recorder.submit();
    EXPECT_THAT(early.values<float>(), testing::Each(-1.0f));
    expect_error(ErrorKind::internal, {"download", "scaled", "end at 16"}, [&] { recorder.download(scaled, 8, 9); });
    expect_error(ErrorKind::internal, {"upload", "scaled"}, [&] { recorder.upload(scaled, bytes_of(iota(1)), 16); });
    expect_error(ErrorKind::internal, {"upload", "empty buffer"}, [&] { recorder.upload(Buffer(), bytes_of(iota(1))); });
}

TEST_P(OneSubmission, ADownloadKeepsItsBuffer) {
    Download download;
    {
        const Buffer gone = upload_new(device, "gone", iota(4));
        download = recorder.download(gone, 0, 16);
    }
    const Buffer other = upload_new(device, "other", iota(4, 100));
    recorder.submit();
    EXPECT_EQ(download.values<uint32_t>(), iota(4));
}

// 20 by 30 workgroups: first of a stage that was never measured, then of one that was.
TEST_P(OneSubmission, WorkgroupsThatTheDeviceCounts) {
    for (uint32_t round = 1; round <= 2; ++round) {
        dispatch_count(700);
        recorder.submit();
        std::vector<uint32_t> expected(kCount, round);
        expected.push_back(0);
        EXPECT_EQ(download_vector<uint32_t>(device, visits, kCount + 1), expected);
    }
    EXPECT_EQ(device.stage_times().at(0).dispatches, 2u);
}

// lavapipe lets an indirect dispatch begin where the last piece of a dispatch did.
TEST_P(OneSubmission, WorkgroupsThatTheDeviceCountsAfterADispatchInPieces) {
    const std::vector<Binding> bindings{{.name = "Visits", .buffer = &visits}};
    recorder.dispatch("count", count_groups, bindings, kCount, kCount);
    dispatch_count(700);
    recorder.submit();
    std::vector<uint32_t> expected(kCount, 2);
    expected.push_back(0);
    EXPECT_EQ(download_vector<uint32_t>(device, visits, kCount + 1), expected);
}

TEST_P(OneSubmission, WorkgroupsThatTheDeviceCountsInTheSameSubmission) {
    recorder.fill("clear", arguments, 1);
    recorder.fill("clear", arguments, 3, 4, 4);
    recorder.fill("clear", arguments, 2, 8, 4);
    dispatch_count(6);
    recorder.fill("clear", arguments, 1);
    recorder.submit();
    EXPECT_THAT(download_vector<uint32_t>(device, visits, 7), testing::ElementsAre(1, 1, 1, 1, 1, 1, 0));
}

TEST_P(OneSubmission, NoWorkgroupsAreFine) {
    upload(device, arguments, bytes_of(std::vector<uint32_t>{0, 0, 30, 1}));
    dispatch_count(0);
    dispatch_count(700);
    recorder.submit();
    EXPECT_THAT(download_vector<uint32_t>(device, visits, kCount + 1), testing::Each(0u));
    EXPECT_EQ(device.stage_times().at(0).dispatches, 1u);
}

TEST_P(OneSubmission, WrongArgumentsAreErrors) {
    const auto expect_refused = [&](const std::vector<uint32_t>& groups, const std::string& what) {
        upload(device, arguments, bytes_of(groups));
        expect_error(ErrorKind::internal, {"stage count", what}, [&] {
            dispatch_count(200);
            recorder.submit();
        });
    };
    expect_refused({0, 3, 67, 1}, "3 x 67 x 1");
    expect_refused({0, 3, 7, 2}, "3 x 7 x 2");
    const std::vector<Binding> bindings{{.name = "Visits", .buffer = &visits}};
    const auto expect_rejected = [&](const Buffer& buffer, uint64_t offset, const std::string& what) {
        expect_error(ErrorKind::internal, {"stage count", what},
                     [&] { recorder.dispatch_indirect("count", count_groups, bindings, kCount, buffer, offset, 7); });
    };
    expect_rejected(arguments, 2, "multiple of 4");
    expect_rejected(arguments, 8, "end at 16");
    expect_rejected(Buffer(), 0, "empty buffer");
    expect_rejected(visits, 0, "'Visits' overlaps");
    upload(device, arguments, bytes_of(std::vector<uint32_t>{0, 1, 1, 1}));
    dispatch_count(200);
    EXPECT_NO_THROW(recorder.submit()) << "the recorder goes on";
}

TEST_P(OneSubmission, SubmissionsAreCounted) {
    device.reset_statistics();
    EXPECT_EQ(device.submissions(), 0u);
    recorder.submit();
    EXPECT_EQ(device.submissions(), 0u) << "of nothing there is none";
    for (uint32_t i = 0; i < 3; ++i) {
        recorder.fill("clear", scaled, i);
        recorder.fill("clear", values, i);
        recorder.submit();
    }
    EXPECT_EQ(device.submissions(), 3u);
    device.reset_statistics();
    EXPECT_EQ(device.submissions(), 0u);
}

TEST_P(OneSubmission, RecordersShareWhatIsExpensive) {
    for (int i = 0; i < 3; ++i) {
        Recorder other(device);
        other.fill("clear", scaled, 1);
        const Download download = other.download(scaled, 0, 4);
        other.submit();
        EXPECT_EQ(download.values<uint32_t>().at(0), 1u);
    }
    EXPECT_EQ(device.impl()->idle_states.size(), 1u);
}

constexpr std::array kNames{"AsTheDeviceCan", "Staged", "InPieces", "StagedWithoutTimestamps"};

INSTANTIATE_TEST_SUITE_P(, OneSubmission, testing::Values("", "mapped=0", "dispatch_ms=0", "mapped=0,timestamps=0"),
                         [](const auto& test) { return kNames[test.index]; });

}  // namespace
}  // namespace gnomon::gpu
