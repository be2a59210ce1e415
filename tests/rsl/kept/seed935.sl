// world 935
light fuzz( frame_8 = -0.5801; ) {
 solar(vector 1, 1) {
 L = 1;
 }
}
