;; What the machine itself can do: kernels that do nothing else. Each is called with how often its loop runs.
(module
  (memory (export "pages") 1)

  ;; Twelve chains that do not wait for each other, as many as the registers hold: 6 products and 6 sums of two lanes a turn.
  (func (export "arithmetic") (param $turns i32) (result f64)
    (local $a v128) (local $b v128) (local $c v128) (local $d v128) (local $e v128) (local $f v128)
    (local $g v128) (local $h v128) (local $i v128) (local $j v128) (local $k v128) (local $l v128)
    (local $one v128) (local $little v128)
    (local.set $one (f64x2.splat (f64.const 0x1.fffffffffffffp-1)))
    (local.set $little (f64x2.splat (f64.const 1e-9)))
    (local.set $a (local.get $one)) (local.set $b (local.get $one)) (local.set $c (local.get $one))
    (local.set $d (local.get $one)) (local.set $e (local.get $one)) (local.set $f (local.get $one))
    (loop $turn
      (local.set $a (f64x2.mul (local.get $a) (local.get $one)))
      (local.set $g (f64x2.add (local.get $g) (local.get $little)))
      (local.set $b (f64x2.mul (local.get $b) (local.get $one)))
      (local.set $h (f64x2.add (local.get $h) (local.get $little)))
      (local.set $c (f64x2.mul (local.get $c) (local.get $one)))
      (local.set $i (f64x2.add (local.get $i) (local.get $little)))
      (local.set $d (f64x2.mul (local.get $d) (local.get $one)))
      (local.set $j (f64x2.add (local.get $j) (local.get $little)))
      (local.set $e (f64x2.mul (local.get $e) (local.get $one)))
      (local.set $k (f64x2.add (local.get $k) (local.get $little)))
      (local.set $f (f64x2.mul (local.get $f) (local.get $one)))
      (local.set $l (f64x2.add (local.get $l) (local.get $little)))
      (br_if $turn (local.tee $turns (i32.sub (local.get $turns) (i32.const 1)))))
    (f64x2.extract_lane 0 (f64x2.add
      (f64x2.add (f64x2.add (local.get $a) (local.get $b)) (f64x2.add (local.get $c) (local.get $d)))
      (f64x2.add
        (f64x2.add (f64x2.add (local.get $e) (local.get $f)) (f64x2.add (local.get $g) (local.get $h)))
        (f64x2.add (f64x2.add (local.get $i) (local.get $j)) (f64x2.add (local.get $k) (local.get $l)))))))

  ;; Six quotients of two lanes a turn.
  (func (export "divisions") (param $turns i32) (result f64)
    (local $a v128) (local $b v128) (local $c v128) (local $d v128) (local $e v128) (local $f v128) (local $by v128)
    (local.set $by (f64x2.splat (f64.const 0x1.0000000000001p0)))
    (local.set $a (local.get $by)) (local.set $b (local.get $by)) (local.set $c (local.get $by))
    (local.set $d (local.get $by)) (local.set $e (local.get $by)) (local.set $f (local.get $by))
    (loop $turn
      (local.set $a (f64x2.div (local.get $a) (local.get $by)))
      (local.set $b (f64x2.div (local.get $b) (local.get $by)))
      (local.set $c (f64x2.div (local.get $c) (local.get $by)))
      (local.set $d (f64x2.div (local.get $d) (local.get $by)))
      (local.set $e (f64x2.div (local.get $e) (local.get $by)))
      (local.set $f (f64x2.div (local.get $f) (local.get $by)))
      (br_if $turn (local.tee $turns (i32.sub (local.get $turns) (i32.const 1)))))
    (f64x2.extract_lane 0 (f64x2.add
      (f64x2.add (f64x2.add (local.get $a) (local.get $b)) (f64x2.add (local.get $c) (local.get $d)))
      (f64x2.add (local.get $e) (local.get $f)))))

  ;; 64 bytes a turn, one after the other.
  (func (export "reading") (param $turns i32) (result f64)
    (local $at i32) (local $a v128) (local $b v128) (local $c v128) (local $d v128)
    (loop $turn
      (local.set $a (v128.xor (local.get $a) (v128.load (local.get $at))))
      (local.set $b (v128.xor (local.get $b) (v128.load offset=16 (local.get $at))))
      (local.set $c (v128.xor (local.get $c) (v128.load offset=32 (local.get $at))))
      (local.set $d (v128.xor (local.get $d) (v128.load offset=48 (local.get $at))))
      (local.set $at (i32.add (local.get $at) (i32.const 64)))
      (br_if $turn (local.tee $turns (i32.sub (local.get $turns) (i32.const 1)))))
    (f64x2.extract_lane 0 (v128.xor
      (v128.xor (local.get $a) (local.get $b)) (v128.xor (local.get $c) (local.get $d)))))

  ;; Six comparisons and six choices of two lanes a turn.
  (func (export "choices") (param $turns i32) (result f64)
    (local $a v128) (local $b v128) (local $c v128) (local $d v128) (local $e v128) (local $f v128) (local $limit v128) (local $other v128)
    (local.set $limit (f64x2.splat (f64.const 1)))
    (local.set $other (f64x2.splat (f64.const 2)))
    (loop $turn
      (local.set $a (v128.bitselect (local.get $other) (local.get $a) (f64x2.lt (local.get $a) (local.get $limit))))
      (local.set $b (v128.bitselect (local.get $other) (local.get $b) (f64x2.lt (local.get $b) (local.get $limit))))
      (local.set $c (v128.bitselect (local.get $other) (local.get $c) (f64x2.lt (local.get $c) (local.get $limit))))
      (local.set $d (v128.bitselect (local.get $other) (local.get $d) (f64x2.lt (local.get $d) (local.get $limit))))
      (local.set $e (v128.bitselect (local.get $other) (local.get $e) (f64x2.lt (local.get $e) (local.get $limit))))
      (local.set $f (v128.bitselect (local.get $other) (local.get $f) (f64x2.lt (local.get $f) (local.get $limit))))
      (br_if $turn (local.tee $turns (i32.sub (local.get $turns) (i32.const 1)))))
    (f64x2.extract_lane 0 (f64x2.add
      (f64x2.add (f64x2.add (local.get $a) (local.get $b)) (f64x2.add (local.get $c) (local.get $d)))
      (f64x2.add (local.get $e) (local.get $f)))))

  ;; Twelve loads a turn, of what the nearest cache holds.
  (func (export "memory") (param $turns i32) (result f64)
    (local $at i32) (local $a v128) (local $b v128) (local $c v128) (local $d v128)
    (loop $turn
      (local.set $at (i32.and (local.get $turns) (i32.const 0x3fc0)))
      (local.set $a (v128.xor (local.get $a) (v128.load (local.get $at))))
      (local.set $b (v128.xor (local.get $b) (v128.load offset=16 (local.get $at))))
      (local.set $c (v128.xor (local.get $c) (v128.load offset=32 (local.get $at))))
      (local.set $d (v128.xor (local.get $d) (v128.load offset=48 (local.get $at))))
      (local.set $a (v128.xor (local.get $a) (v128.load offset=64 (local.get $at))))
      (local.set $b (v128.xor (local.get $b) (v128.load offset=80 (local.get $at))))
      (local.set $c (v128.xor (local.get $c) (v128.load offset=96 (local.get $at))))
      (local.set $d (v128.xor (local.get $d) (v128.load offset=112 (local.get $at))))
      (local.set $a (v128.xor (local.get $a) (v128.load offset=128 (local.get $at))))
      (local.set $b (v128.xor (local.get $b) (v128.load offset=144 (local.get $at))))
      (local.set $c (v128.xor (local.get $c) (v128.load offset=160 (local.get $at))))
      (local.set $d (v128.xor (local.get $d) (v128.load offset=176 (local.get $at))))
      (br_if $turn (local.tee $turns (i32.sub (local.get $turns) (i32.const 1)))))
    (f64x2.extract_lane 0 (v128.xor
      (v128.xor (local.get $a) (local.get $b)) (v128.xor (local.get $c) (local.get $d)))))

  ;; Twelve operations on whole numbers a turn, as a generator has them.
  (func (export "whole") (param $turns i32) (result f64)
    (local $a i64) (local $b i64) (local $c i64) (local $d i64) (local $e i64) (local $f i64)
    (local.set $a (i64.const 1)) (local.set $b (i64.const 2)) (local.set $c (i64.const 3))
    (local.set $d (i64.const 4)) (local.set $e (i64.const 5)) (local.set $f (i64.const 6))
    (loop $turn
      (local.set $a (i64.add (i64.rotl (local.get $a) (i64.const 7)) (i64.const 1000)))
      (local.set $b (i64.xor (i64.add (local.get $b) (i64.const 5)) (i64.const 1001)))
      (local.set $c (i64.add (i64.rotl (local.get $c) (i64.const 9)) (i64.const 1002)))
      (local.set $d (i64.xor (i64.add (local.get $d) (i64.const 9)) (i64.const 1003)))
      (local.set $e (i64.add (i64.rotl (local.get $e) (i64.const 11)) (i64.const 1004)))
      (local.set $f (i64.xor (i64.add (local.get $f) (i64.const 13)) (i64.const 1005)))
      (br_if $turn (local.tee $turns (i32.sub (local.get $turns) (i32.const 1)))))
    (f64.convert_i64_u (i64.xor
      (i64.xor (i64.xor (local.get $a) (local.get $b)) (i64.xor (local.get $c) (local.get $d)))
      (i64.xor (local.get $e) (local.get $f))))))
