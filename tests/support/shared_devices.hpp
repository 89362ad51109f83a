// SPDX-License-Identifier: Apache-2.0
// What the tests of one process share, because it takes long to make.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <gnomon/render.hpp>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon::test {

/// Runs what it is given after the last test, the last first.
class EndOfTests : public testing::Environment {
public:
    static void add(std::function<void()> end) {
        static auto* environment = static_cast<EndOfTests*>(testing::AddGlobalTestEnvironment(new EndOfTests));
        environment->ends_.push_back(std::move(end));
    }
    void TearDown() override {
        for (; !ends_.empty(); ends_.pop_back()) ends_.back()();
    }

private:
    std::vector<std::function<void()>> ends_;
};

/// The static object, made with these arguments where it is not there, and destroyed before main returns: the validation layer
/// of Debian 13 (1.4.309) has ended before static objects are destroyed.
template <class T, class... Arguments>
T& make_once(std::unique_ptr<T>& object, Arguments&&... arguments) {
    if (!object) {
        object = std::make_unique<T>(std::forward<Arguments>(arguments)...);
        EndOfTests::add([&object] { object.reset(); });
    }
    return *object;
}

/// Any message of the validation layer is an Error.
inline Renderer& validated_renderer() {
    static std::unique_ptr<Renderer> renderer;
    return make_once(renderer, "", true);
}

}  // namespace gnomon::test
