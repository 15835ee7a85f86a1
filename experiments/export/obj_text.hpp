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
  /// Run and surface outlive it. Positions are relative to `origin`, which the text states unless it is 0.
  ObjText(const ExportedRun& run, const Surface& surface, const Vector3& origin = Vector3::Zero());

  void write(OutputFile& file, const ExportedFrame& frame) const;

 private:
  const ExportedRun& run_;
  const Surface& surface_;
  Vector3 origin_;
  std::string head_, tail_;  // the same in every frame
};

}  // namespace bendlab
