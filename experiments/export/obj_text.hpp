// Wavefront OBJ, for the formats that need it.
#pragma once

#include <string>

#include "experiments/export/exported_run.hpp"
#include "experiments/export/output.hpp"

namespace bendlab {

/// A surface of a run as OBJ text, with texture coordinates if it has some. Positions have the fewest digits
/// that read back to the same numbers: of a float, where the run stored floats.
class ObjText {
 public:
  /// Both outlive it.
  ObjText(const ExportedRun& run, const Surface& surface);

  void write(OutputFile& file, const ExportedFrame& frame) const;

 private:
  const ExportedRun& run_;
  const Surface& surface_;
  std::string head_, tail_;  // the same in every frame
};

}  // namespace bendlab
