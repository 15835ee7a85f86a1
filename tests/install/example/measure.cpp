#include "mine.hpp"

using namespace bendlab;

struct Height final : Measurement {
  void finish(const RunEnd& end, Findings& findings) override {
    findings.summary["height"] = end.simulation.positions().col(2).mean();
  }
};

const Measure height{
    .name = "height",
    .summary = "where the cloth is at the end",
    .cost = "nothing",
    .gives = []() -> std::vector<Quantity> {
      return {{"height", "m", "mean z of the vertices"}};
    },
    .begin = [](auto&, auto&) -> std::unique_ptr<Measurement> { return std::make_unique<Height>(); }};
