#pragma once
// What the x86 lane types share whatever their width: arithmetic by the compiler's vector
// extensions, and the comparisons that follow from others.

LIGHTBENCH_KERNEL_BEGIN

inline Real operator+(Real a, Real b) { return Real(a.v + b.v); }
inline Real operator-(Real a, Real b) { return Real(a.v - b.v); }
inline Real operator*(Real a, Real b) { return Real(a.v * b.v); }
inline Real operator/(Real a, Real b) { return Real(a.v / b.v); }
inline Real operator-(Real a) { return Real(-a.v); }
inline Real& operator+=(Real& a, Real b) { return a = a + b; }
inline Real& operator-=(Real& a, Real b) { return a = a - b; }
inline Real& operator*=(Real& a, Real b) { return a = a * b; }

inline Int operator+(Int a, Int b) { return Int(a.v + b.v); }
inline Int operator-(Int a, Int b) { return Int(a.v - b.v); }
inline Int operator*(Int a, Int b) { return Int(a.v * b.v); }
inline Int operator&(Int a, Int b) { return Int(a.v & b.v); }
inline Int operator|(Int a, Int b) { return Int(a.v | b.v); }
inline Int operator^(Int a, Int b) { return Int(a.v ^ b.v); }
inline Int operator<<(Int a, int n) { return Int(a.v << n); }
inline Int operator>>(Int a, int n) { return Int(a.v >> n); }
inline Int& operator+=(Int& a, Int b) { return a = a + b; }
inline Int& operator^=(Int& a, Int b) { return a = a ^ b; }
inline Int& operator*=(Int& a, Int b) { return a = a * b; }

inline Mask operator>(Real a, Real b) { return b < a; }
inline Mask operator>=(Real a, Real b) { return b <= a; }
inline Mask operator>(Int a, Int b) { return b < a; }
inline Mask operator>=(Int a, Int b) { return !(a < b); }
inline Mask operator<=(Int a, Int b) { return !(b < a); }
inline Mask operator!=(Int a, Int b) { return !(a == b); }
inline Mask operator==(Mask a, Mask b) { return !(a != b); }
inline Mask select(Mask m, Mask a, Mask b) { return (m && a) || (!m && b); }
inline bool any(Mask m) { return bits(m) != 0; }
inline bool none(Mask m) { return bits(m) == 0; }
inline Int min(Int a, Int b) { return select(a < b, a, b); }

LIGHTBENCH_KERNEL_END
