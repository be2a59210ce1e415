// #line, #pragma, # 12 "file", #ident, a lone #
#line 100 "made.sl"
# 12 "other.sl"
#pragma annotation "name" "gray"
#pragma annotation Kd "gadgettype=floatslider;min=0;max=1;label=Kd;"
#ident "$Id: gray.sl $"
#
#pragma once
surface preprocessor_lines(float Kd = 1) { Ci = Kd; }
