class other(float gain = 4; color tint = color(0.125); string label = "hello"; uniform float list[3] = {1,2,3}) {
  public void nothing() {}
}
