#define METHOD(NAME, EXPR) public float NAME(float x) { return (EXPR); }
#define FOR_EACH(i, arr) for (i = 0; i < arraylength(arr); i += 1)
class methods(float k = 2) {
  METHOD(twice, 2*x)
  METHOD(square, x*x)
  METHOD(scaled, twice(x) * k)
  float opt(float a; float b = 3; string mode = "add") {
     if (mode == "add") return a + b;
     else if (mode == "mul") return a * b;
     return -1;
  }
  color opt(color a) { return a * 10; }
  shader pick(shader a, b; float which) { if (which > 0.5) return b; return a; }
  void fill(output float arr[]; uniform float n) { uniform float i; resize(arr, n); for (i = 0; i < n; i += 1) arr[i] = i + 1; }
  float sum(float arr[]) { float t = 0; uniform float i; FOR_EACH(i, arr) t += arr[i]; return t; }
  float maxof(float arr[4];) { float m = arr[0]; float i; for (i = 1; i < 4; i += 1) if (arr[i] > m) m = arr[i]; return m; }
  public void surface(output color Ci, Oi) {
     float a[]; fill(a, 4);
     float b[4]; b = a;
     uniform float i = 0;
     float skip = 0;
     while (1 == 1) { i += 1; if (i == 2) continue; if (i > 4) break; skip += i; }
     Ci = color(twice(square(k)), sum(a), maxof(b));
     Oi = color(opt(1), opt(2, 5, "mul"), comp(opt(color(0.1)), 0) + skip + scaled(1));
  }
}
