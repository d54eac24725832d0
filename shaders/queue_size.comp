// Work groups of the ray cast from the length of its queue.
layout(local_size_x = 1) in;
layout(std430, binding = counters_buffer) buffer Counters { uint counters[]; };

void main() {
  counters[4] = (counters[0] + 63u) / 64u;
  counters[5] = 1u;
  counters[6] = 1u;
}
