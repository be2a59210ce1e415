// names that are words elsewhere
class names(float input = 1; float class_ = 2; float begin = 3; float opacity = .5; color light = 1; float in = 4; float type = 5; float method = 6;
            float int = 7; float volume = 8; float bool = 9; float member = 10; float static = 11; float new = 12; float delete = 13; float char = 14; float long = 15; float short = 16; float const = 17; float double = 18; float unsigned = 19; float signed = 20; float virtual = 21;) {
  float samples = 3, direction = 2; float radiance[2] = {1, 2}; float resize_ = 0;
  public void surface(output color Ci, Oi) {
     float struct_ = input + class_ + begin + in + type + method + int + volume + bool + member + static + new;
     float push_ = 1; float value = struct_; float out = 2; float point_ = 3; float handle = 1; float category = 2;
     Ci = color(value, samples * direction, radiance[1]) * light; Oi = opacity;
  }
}
