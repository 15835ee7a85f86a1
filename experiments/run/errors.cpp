#include "experiments/run/errors.hpp"

#include <new>
#include <system_error>

#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/strict_json.hpp"
#include "experiments/run/needs.hpp"

namespace bendlab {

Failure current_failure() {
  try {
    throw;
  } catch (const UsageError& error) {
    return {exit_usage, error.what()};
  } catch (const ConfigError& error) {
    return {exit_config, error.what()};
  } catch (const ConfigsError& error) {
    return {exit_config, error.what()};
  } catch (const MeshError& error) {
    return {exit_mesh, error.what()};
  } catch (const MeshFileError& error) {
    return {error.kind() == MeshFileError::Kind::refused ? exit_mesh : exit_io, error.what()};
  } catch (const RunFileError& error) {
    return {exit_io, error.what()};
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again)
      return {exit_failed,
              "no more threads can be started: compute fewer runs at the same time (--jobs 1), or allow the "
              "process more memory (ulimit -v) or more threads (ulimit -u)"};
    return {exit_io, error.what()};
  } catch (const NoRoom& error) {
    return {exit_failed, error.what()};
  } catch (const std::bad_alloc&) {
    return {exit_failed, "out of memory: compute fewer runs at once (--jobs 1), or choose a coarser mesh"};
  } catch (const std::exception& error) {
    return {exit_failed, error.what()};
  }
}

}  // namespace bendlab
