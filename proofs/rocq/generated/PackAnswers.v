(** What the kernel answers, written by `ROCQ_UPDATE=always cargo test -p tautline-proofs --test all rocq`. Do not edit. *)
From Coq Require Import ZArith NArith List.
Import ListNotations.

Definition reach : Z := 6.
Definition links_REPAIRED : list (Z * N) := [(3%Z,0x000000000000000e00f807c03e00e00000000000000%N);(4%Z,0x000000000001c01f01fc0fe07f01f00700000000000%N);
  (5%Z,0x000000003807f03f83fe1ff0ff83f81fc0380000000%N)].
Definition links_PUBLISHED : list (Z * N) := [(3%Z,0x000000000000801f00f80fe03e01f00200000000000%N);(4%Z,0x000000001003e03f81fc1ff07f03f80f80100000000%N);
  (5%Z,0x00000200fe0ff87fc3fe3ff8ff87fc3fe0fe0080000%N)].
Definition width : Z := 5.
Definition runs : list (Z * list (Z * Z) * list (Z * Z) * list (bool * list nat)) := [
 (3%Z,[(2,4);(2,3)]%Z,[(1,2);(4,3);(4,2);(4,0);(1,1);(3,4)]%Z,
  [(false,[4;0]%nat);(false,[3;3]%nat);(false,[3;3]%nat);(false,[3;0]%nat);(false,[3;2]%nat);(false,[2;2]%nat);
  (false,[2;3]%nat);(false,[1;1]%nat);(false,[1;1]%nat);(false,[1;1]%nat)]);
 (3%Z,[(3,0);(0,2);(1,1)]%Z,[(0,4);(3,2);(4,3);(4,0);(2,0);(1,3)]%Z,
  [(false,[1;0;2]%nat);(false,[4;0;1]%nat);(false,[0;4;1]%nat);(false,[1;1;3]%nat);(false,[4;4;0]%nat);
  (false,[4;0;0]%nat);(false,[3;1;4]%nat);(false,[2;2;1]%nat)]);
 (3%Z,[(1,2);(4,3);(0,0);(3,2)]%Z,[(1,1);(0,2);(2,1);(4,4);(1,3);(1,0)]%Z,
  [(false,[4;2;4;3]%nat);(false,[4;4;4;1]%nat);(false,[4;1;4;1]%nat);(true,[4;3;4;3]%nat);(false,[4;4;4;0]%nat);
  (false,[4;4;4;3]%nat);(false,[4;4;4;1]%nat);(false,[4;4;4;1]%nat);(true,[4;4;4;3]%nat);(false,[4;4;4;1]%nat);
  (true,[4;4;4;3]%nat);(true,[4;4;4;3]%nat);(false,[4;4;4;1]%nat);(false,[4;4;4;1]%nat);(true,[4;4;4;3]%nat);
  (true,[4;4;4;3]%nat);(true,[4;4;4;1]%nat);(true,[4;4;4;2]%nat);(false,[4;1;4;1]%nat);(false,[4;2;4;1]%nat);
  (false,[4;4;4;3]%nat);(false,[4;0;4;3]%nat);(false,[4;3;4;3]%nat);(false,[4;3;4;3]%nat);(false,[4;4;4;1]%nat);
  (false,[4;1;4;1]%nat);(false,[4;1;4;1]%nat);(false,[4;2;4;1]%nat);(false,[4;2;4;2]%nat);(false,[4;2;4;2]%nat)]);
 (3%Z,[(2,1);(4,0)]%Z,[(2,0);(3,3);(0,1);(0,0);(4,1);(0,4)]%Z,
  [(false,[4;2]%nat);(false,[1;1]%nat);(false,[1;2]%nat);(false,[2;2]%nat);(false,[2;4]%nat);(false,[0;0]%nat);
  (false,[0;1]%nat);(false,[4;0]%nat);(false,[1;2]%nat);(false,[0;0]%nat);(false,[0;0]%nat);(false,[2;2]%nat);
  (false,[2;2]%nat);(false,[2;2]%nat);(false,[3;3]%nat);(false,[3;3]%nat)]);
 (3%Z,[(2,2);(3,1);(2,1)]%Z,[(3,0);(0,0);(4,1);(1,2);(0,2);(2,4)]%Z,
  [(false,[1;1;2]%nat);(false,[0;4;4]%nat);(false,[1;4;4]%nat);(false,[3;4;4]%nat);(false,[2;1;4]%nat);
  (false,[2;2;2]%nat);(false,[4;4;0]%nat);(false,[1;2;0]%nat)]);
 (3%Z,[(2,4);(3,4)]%Z,[(2,1);(3,3);(4,4);(2,3);(2,0);(3,2)]%Z,
  [(false,[2;2]%nat);(false,[3;2]%nat);(false,[3;2]%nat);(false,[4;0]%nat);(false,[4;3]%nat);(false,[3;3]%nat);
  (false,[3;0]%nat)]);
 (3%Z,[(2,2);(3,1);(2,1)]%Z,[(1,0);(4,1);(1,1);(0,3);(2,3);(3,3)]%Z,
  [(false,[0;3;3]%nat);(false,[0;1;0]%nat);(false,[1;1;1]%nat);(false,[1;0;1]%nat);(false,[2;1;0]%nat);
  (false,[2;4;2]%nat);(false,[4;3;2]%nat);(false,[2;2;2]%nat);(false,[2;2;1]%nat);(false,[0;2;4]%nat);
  (false,[4;2;3]%nat);(false,[3;3;2]%nat)]);
 (3%Z,[(2,2);(2,1)]%Z,[(3,3);(1,4);(1,0);(0,4);(0,0);(3,1)]%Z,
  [(false,[1;2]%nat);(false,[4;1]%nat);(false,[1;1]%nat);(false,[0;0]%nat);(false,[0;4]%nat);(false,[2;3]%nat);
  (false,[2;0]%nat);(false,[3;2]%nat);(false,[4;2]%nat);(false,[3;2]%nat);(false,[3;3]%nat);(false,[3;0]%nat);
  (false,[0;0]%nat);(false,[0;4]%nat);(false,[1;1]%nat);(false,[1;1]%nat);(false,[2;2]%nat);(false,[2;2]%nat)]);
 (3%Z,[(2,2);(4,1);(3,3)]%Z,[(0,4);(2,3);(4,3);(3,4);(3,1);(0,1)]%Z,
  [(false,[2;1;3]%nat);(false,[1;4;2]%nat);(false,[3;3;3]%nat);(false,[3;3;4]%nat);(false,[1;1;1]%nat);
  (false,[1;1;4]%nat);(false,[1;2;2]%nat);(false,[3;2;3]%nat);(false,[3;4;3]%nat)]);
 (3%Z,[(2,3);(4,3);(3,0);(3,1)]%Z,[(3,4);(3,2);(0,2);(4,1);(1,3);(2,4)]%Z,
  [(false,[0;4;2;2]%nat);(false,[2;2;2;1]%nat);(false,[4;4;1;2]%nat)]);
 (3%Z,[(4,2);(4,0);(2,1)]%Z,[(2,2);(4,4);(2,0);(0,0);(0,1);(0,3)]%Z,
  [(false,[4;1;0]%nat);(false,[1;1;1]%nat);(false,[2;1;4]%nat);(false,[2;2;4]%nat);(false,[2;1;4]%nat);
  (false,[3;2;3]%nat);(false,[4;2;2]%nat);(false,[2;3;2]%nat);(false,[0;4;3]%nat)]);
 (3%Z,[(2,2);(3,3)]%Z,[(4,4);(1,3);(3,1);(1,4);(1,0);(4,2)]%Z,
  [(false,[2;3]%nat);(false,[4;1]%nat);(false,[4;2]%nat);(false,[2;3]%nat);(false,[3;3]%nat);(false,[0;3]%nat);
  (false,[0;0]%nat);(false,[1;2]%nat);(false,[4;1]%nat);(false,[1;1]%nat);(false,[1;0]%nat);(false,[0;1]%nat);
  (false,[2;2]%nat);(false,[4;3]%nat);(false,[3;2]%nat);(false,[3;2]%nat);(false,[2;1]%nat);(false,[0;3]%nat);
  (false,[3;0]%nat);(false,[3;0]%nat);(false,[0;3]%nat);(false,[0;3]%nat)]);
 (3%Z,[(1,3);(2,2);(4,3)]%Z,[(2,3);(2,0);(0,3);(4,1);(0,0);(1,2)]%Z,
  [(false,[1;4;3]%nat);(false,[0;0;4]%nat);(false,[0;3;2]%nat);(false,[3;3;2]%nat);(false,[3;1;3]%nat);
  (false,[2;4;2]%nat);(false,[3;4;2]%nat)]);
 (3%Z,[(0,0);(4,2);(3,2);(2,0)]%Z,[(4,1);(1,3);(1,4);(2,3);(4,3);(3,0)]%Z,
  [(false,[1;4;4;1]%nat);(false,[1;4;1;1]%nat);(false,[1;2;4;2]%nat);(false,[1;2;3;2]%nat);(false,[3;4;1;0]%nat);
  (false,[3;0;1;0]%nat)]);
 (3%Z,[(3,1);(2,1)]%Z,[(0,4);(2,0);(0,0);(0,3);(2,3);(4,2)]%Z,
  [(false,[0;1]%nat);(false,[2;2]%nat);(false,[2;1]%nat);(false,[2;3]%nat);(false,[0;0]%nat);(false,[0;0]%nat);
  (false,[4;2]%nat);(false,[1;2]%nat);(false,[1;1]%nat);(false,[1;1]%nat);(false,[2;3]%nat);(false,[2;3]%nat);
  (false,[3;2]%nat);(false,[3;3]%nat)]);
 (3%Z,[(3,1);(2,0);(4,3)]%Z,[(3,0);(4,0);(0,3);(3,2);(1,4);(3,3)]%Z,
  [(false,[4;2;3]%nat);(false,[2;1;3]%nat);(false,[1;1;2]%nat);(false,[1;1;4]%nat);(false,[4;4;2]%nat);
  (false,[1;0;1]%nat)]);
 (3%Z,[(3,3);(4,2)]%Z,[(3,1);(3,0);(3,4);(1,3);(1,4);(2,1)]%Z,
  [(false,[2;1]%nat);(false,[3;3]%nat);(false,[0;3]%nat);(false,[2;1]%nat);(false,[4;1]%nat);(false,[4;2]%nat);
  (false,[2;2]%nat);(false,[0;1]%nat);(false,[2;3]%nat);(false,[2;3]%nat);(false,[1;2]%nat);(false,[3;3]%nat);
  (false,[3;3]%nat);(false,[0;0]%nat)]);
 (3%Z,[(2,1);(0,2);(3,3)]%Z,[(2,0);(3,1);(4,4);(3,2);(3,4);(1,2)]%Z,
  [(false,[4;4;2]%nat);(false,[2;1;1]%nat);(false,[2;4;2]%nat);(false,[0;0;0]%nat);(false,[0;0;4]%nat);
  (false,[1;0;3]%nat);(false,[4;0;0]%nat);(false,[1;3;0]%nat);(false,[0;3;3]%nat);(false,[0;3;3]%nat)]);
 (3%Z,[(2,3);(3,3);(2,1);(1,3)]%Z,[(1,2);(4,2);(0,4);(4,1);(1,4);(3,4)]%Z,
  [(false,[4;3;2;2]%nat);(false,[0;3;4;3]%nat);(false,[0;4;3;3]%nat);(false,[2;4;0;0]%nat);(false,[3;3;4;0]%nat)])].
