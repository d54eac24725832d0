in float unknown;
flat in float cell_unknown;

void main() { put_ground(max(unknown, cell_unknown)); }
