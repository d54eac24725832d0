in float unknown;

void main() { put_ground(unknown); }
