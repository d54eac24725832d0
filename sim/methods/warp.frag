// The mesh is drawn where the cell below is known; the unknown begins and ends where its cells do,
// however far apart the vertices stand.
in vec2 at;
in float carried;

void main() {
  float unknown = 0.0;
  if (warp_asks.w > 0.5) unknown = bilinear_height(at).y;
  put_ground(unknown);
}
