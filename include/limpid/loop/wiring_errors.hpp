// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

/// What is wrong with a loop, as types whose names are sentences; the compiler prints one in the failed static_assert
/// `loop_is_sound<SENTENCE>`.
namespace limpid::loop_error {

struct none {};

template <typename Sentence>
inline constexpr bool loop_is_sound = std::is_same_v<Sentence, none>;

/// no_block_writes<ToolSample>::which<ModelPredictor>::reads     no_block_writes<JointTorque>::which_is_wanted
template <typename Signal>
struct no_block_writes {
  template <typename Block>
  struct which {
    struct reads {};
  };
  struct which_is_wanted {};
};

/// two_blocks_write<JointTorque>::namely<Tracking, Impedance>
template <typename Signal>
struct two_blocks_write {
  template <typename First, typename Second>
  struct namely {};
};

/// the_input<OperatorForce>::is_also_written_by<Sensor>
template <typename Signal>
struct the_input {
  template <typename Block>
  struct is_also_written_by {};
};

/// a_cycle<block<Tracking>::reads<JointState>::from<Arm>,
/// block<Arm>::reads<JointTorque>::from<Tracking>>::without_Previous
template <typename... Steps>
struct a_cycle {
  struct without_Previous {};
};

/// signal<JointTorque>::needs_a_static_function_initial_because::it_is_read_as_Previous_by<Observer>
template <typename Signal>
struct signal {
  struct needs_a_static_function_initial_because {
    template <typename Block>
    struct it_is_read_as_Previous_by {};
    template <typename Block>
    struct its_writer_may_be_skipped {};
  };
};

/// block<Tracking>::cannot_be_called_with<Time, double>, and so on
template <typename Block>
struct block {
  /// a step of a cycle
  template <typename Signal>
  struct reads {
    template <typename Writer>
    struct from {};
  };
  struct writes_nothing {};
  template <typename... Arguments>
  struct cannot_be_called_with {};
  template <typename... Arguments>
  struct has_an_active_that_cannot_be_called_with {};
  template <typename Returned>
  struct returns {
    /// or structs {value, status}; a std::tuple of these where they are several
    template <typename... Values>
    struct instead_of {};
  };
};

/// A sentence on its way; of two the first stands.
template <typename Sentence>
struct Verdict {
  using sentence = Sentence;

  template <typename Next>
  constexpr auto operator&&(Verdict<Next>) const noexcept {
    return Verdict<std::conditional_t<loop_is_sound<Sentence>, Next, Sentence>>{};
  }
};

using Fine = Verdict<none>;

}  // namespace limpid::loop_error
