#include <bendlab/bendlab.hpp>
using namespace bendlab;

int main() {
  Scene scene;
  scene.mesh = grid(1, 1, 64);
  scene.pins.vertices = {Place::upper_left, Place::upper_right};
  scene.effects = {Gravity{}, Wind{.velocity = {0, 3, 0}}};
  Cloth cloth = simulate(scene);
  while (cloth.time() < 4) cloth.step();
  return cloth.positions().allFinite() ? 0 : 1;
}
