// XDMF: a text file with which ParaView before 5.12 reads the run file. The text file has no positions, so it
// needs the run file.
#include "experiments/export/format.hpp"

namespace bendlab {
namespace {

void write_xdmf(const ExportedRun& run, Output& output) {
  const std::filesystem::path to = std::filesystem::absolute(output.to());
  const std::filesystem::path seen = std::filesystem::proximate(std::filesystem::absolute(run.record.file),
                                                                output.is_file() ? to.parent_path() : to);
  std::vector<std::int64_t> frames;
  for (const ExportedFrame& frame : run.frames) frames.push_back(frame.number);
  output.file(output.stem_of(run.surfaces.front()) + ".xdmf",
              [&](OutputFile& file) { file.write(xdmf_of(run.record.file, seen.string(), frames)); });
}

}  // namespace

namespace format {
extern const Format xdmf{
    .name = "xdmf",
    .summary = "a text file with which ParaView before 5.12 reads the run file; --up has no effect",
    .in_one_file = InOneFile::everything,
    .has_times = true,
    .write = write_xdmf,
};
}  // namespace format
}  // namespace bendlab
