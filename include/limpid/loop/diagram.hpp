// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/loop/block.hpp>
#include <limpid/loop/loop.hpp>
#include <limpid/loop/signal.hpp>
#include <limpid/loop/wiring.hpp>

#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/type.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace limpid {

namespace wiring {

/// Writes a graph in the DOT language.
class Dot {
 public:
  void node(const std::string& id, const std::string& label, std::string_view attributes) {
    text_ += "  " + id + " [label=\"" + escaped(label) + "\", " + std::string(attributes) + "];\n";
  }
  void edge(const std::string& from, const std::string& to, const std::string& label, std::string_view attributes) {
    text_ += "  " + from + " -> " + to + " [label=\"" + escaped(label) + "\"" + std::string(attributes) + "];\n";
  }
  [[nodiscard]] std::string text() const { return "digraph loop {\n  rankdir=LR;\n" + text_ + "}\n"; }

 private:
  static std::string escaped(const std::string& label) {
    std::string safe;
    for (const char c : label) safe += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    return safe;
  }

  std::string text_;
};

template <typename Wiring>
class Drawing {
 public:
  template <typename... W, typename... In>
  static std::string draw(wants<W...>, inputs<In...>) {
    Dot dot;
    (dot.node(input_id<In>(), std::string(name_of<In>()), "shape=plaintext"), ...);
    draw_blocks(dot, std::make_index_sequence<Wiring::size>{});
    (draw_wanted<W>(dot, index<boost::hana::tuple<boost::hana::type<W>...>, W>), ...);
    return dot.text();
  }

 private:
  static std::string block_id(std::size_t i) { return "block" + std::to_string(i); }

  template <typename S>
  static std::string input_id() {
    return "input" + std::to_string(index<typename Wiring::Inputs, S>);
  }

  template <std::size_t... I>
  static void draw_blocks(Dot& dot, std::index_sequence<I...>) {
    (dot.node(block_id(I), std::string(name_of<tag_of<typename Wiring::template Block<I>>>()),
              Wiring::kept[I] ? "shape=box" : "shape=box, style=dashed"),
     ...);
    (boost::hana::for_each(typename Wiring::template Block<I>::reads{},
                           [&](auto entry) { draw_edges<typename decltype(entry)::type>(dot, I); }),
     ...);
  }

  template <typename Entry>
  static void draw_edges(Dot& dot, std::size_t reader) {
    using S = typename Reading<Entry>::signal;
    const std::string label = (Reading<Entry>::previous ? "previous " : "") + std::string(name_of<S>());
    const auto draw = [&](const std::string& from, bool kept) {
      dot.edge(from, block_id(reader), label, kept ? "" : ", style=dashed");
    };
    if constexpr (Wiring::template is_input<S>) draw(input_id<S>(), Wiring::kept[reader]);
    for (std::size_t i = 0; i < Wiring::size; ++i) {
      if (Wiring::template writers<S>[i]) draw(block_id(i), Wiring::kept[i] && Wiring::kept[reader]);
    }
  }

  template <typename S>
  static void draw_wanted(Dot& dot, std::size_t place) {
    const std::string id = "wanted" + std::to_string(place);
    dot.node(id, std::string(name_of<S>()), "shape=plaintext");
    if constexpr (Wiring::template is_input<S>) {
      dot.edge(input_id<S>(), id, "", "");
    } else {
      dot.edge(block_id(first(Wiring::template writers<S>)), id, "", "");
    }
  }
};

}  // namespace wiring

/// The loop as a block diagram in the DOT language of Graphviz: `dot -Tsvg`. Blocks that serve nothing that is wanted,
/// and so are no part of the loop, are dashed. For people, between runs (allocates).
template <typename... W, typename... In, typename... Given>
[[nodiscard]] std::string diagram(const Loop<wants<W...>, inputs<In...>, Given...>&) {
  using Wiring = wiring::Wiring<wants<W...>, inputs<In...>, Given...>;
  return wiring::Drawing<Wiring>::draw(wants<W...>{}, inputs<In...>{});
}

}  // namespace limpid
