// How many constraints a bending model will build on a mesh that is not made yet: for the forecast of a run's
// memory and time.
#pragma once

namespace bendlab {

/// What is known of a mesh before it is made. Counts are near enough if they are within a few percent.
struct ExpectedMesh {
  double vertices = 0, triangles = 0, edges = 0;
  double hinges = 0;       ///< edges between two triangles
  double size = 0;         ///< m, diagonal of the rest box
  double mean_edge = 0;    ///< m
  double ring_growth = 6;  ///< ring r of an inner vertex has about this times r vertices, r ≥ 2
  double along = 0;        ///< edges from one side to the other, the longer way
  double across = 0;       ///< … and the shorter way; infinite on a closed surface
  double pinned = 0;       ///< pinned vertices
};

/// Constraints by what they take: two vertices at a distance, two ends of an arc, four vertices of a hinge.
struct ExpectedConstraints {
  double springs = 0, arcs = 0, hinges = 0;
  double reach = 2;   ///< edges between the vertices that are farthest apart in one constraint
  double chosen = 0;  ///< of the springs those that a search in a whole ring finds
};

/// Vertices in rings `first` … `last` of a vertex, mean over the mesh, whose boundary cuts rings off.
double expected_in_rings(const ExpectedMesh& mesh, int first, int last);

}  // namespace bendlab
